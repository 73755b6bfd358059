#include "svoBackendChoice.h"

#include "svoEraseIf.h"
#include "svoLightCode.h"
#include "svoMeshOctree.h"
#include "svoOpenGL.h"
#include "svoOpenGLTracer.h"
#include "svoShadowMask.h"

#include "vtkNew.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkPlaneSource.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

namespace svo
{
namespace
{
constexpr int Cells = 96; // of the waves, squared
constexpr int Level = 8;  // few triangles in a brick

/// Pictures. The first has everything ready, the others count.
constexpr int Width = 512, Heights[] = { 16, 64, 256 };

/// Says to a shadow mask that the waves are seen from `Above`, a little over their triangles, which
/// cut off crests.
constexpr double Above = 2.0;
constexpr char Places[] = R"(//VTK::System::Dec
//VTK::Output::Dec
in vec2 texCoord;
void main()
{
  vec2 at = 2.0 * texCoord - 1.0;
  vec2 wave = vec2(11.0, 7.0) * at;
  float height = 0.1 * sin(wave.x) * sin(wave.y);
  vec2 slope = vec2(1.1 * cos(wave.x) * sin(wave.y), 0.7 * sin(wave.x) * cos(wave.y));
  vec2 folded = -slope / (1.0 + abs(slope.x) + abs(slope.y));
  gl_FragData[0] = vec4(at, height - 2.0 + 0.001, 0.0);
  gl_FragData[1] = 0.5 + 0.5 * folded.xyxy;
}
)";

Octree makeWaves(const ParallelFor& parallelFor)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-1.0, -1.0, 0.0);
  plane->SetPoint1(1.0, -1.0, 0.0);
  plane->SetPoint2(-1.0, 1.0, 0.0);
  plane->SetResolution(Cells, Cells);
  plane->Update();
  vtkPoints* points = plane->GetOutput()->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double p[3];
    points->GetPoint(i, p);
    points->SetPoint(i, p[0], p[1], 0.1 * std::sin(11.0 * p[0]) * std::sin(7.0 * p[1]));
  }
  MeshOctreeOptions options;
  options.level = Level;
  options.parallelFor = parallelFor;
  Octree octree;
  std::string message;
  buildMeshOctree(plane->GetOutput(), options, octree, message);
  return octree;
}

/// Pixels a second of the fastest picture. After one that takes longer, seconds, there is none that
/// is larger.
template <class Draw>
double rateOf(double longest, const Draw& draw)
{
  double best = 0.0;
  for (const int height : Heights)
  {
    const auto start = std::chrono::steady_clock::now();
    draw(height);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    if (height != Heights[0])
    {
      best = std::max(best, Width * height / took.count());
      if (took.count() > longest)
      {
        break;
      }
    }
  }
  return best;
}

View viewOf(int height)
{
  View view;
  makeView(glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, -Above)),
    glm::ortho(-1.0, 1.0, -1.0, 1.0, 1.0, 3.0), Width, height, view);
  return view;
}
}

bool isSoftwareRenderer(const std::string& name)
{
  const char* const software[] = { "llvmpipe", "softpipe", "swr", "SWR", "Software Rasterizer",
    "Software Renderer", "Microsoft Basic Render Driver", "GDI Generic", "SwiftShader" };
  return std::any_of(std::begin(software), std::end(software),
    [&name](const char* one) { return name.find(one) != std::string::npos; });
}

RayRates measureRays(vtkOpenGLRenderWindow* window, const ParallelFor& parallelFor)
{
  Scene scene;
  scene.instances.resize(1);
  scene.instances[0].body.own().octree = makeWaves(parallelFor);
  scene.lights.resize(1);
  scene.lights[0].direction = glm::normalize(glm::dvec3(1.0, 0.4, -0.4));
  FrameSettings settings;
  settings.shadowTechnique = ShadowTechnique::Rays;
  RayRates rates;
  const std::unique_ptr<Tracer> cpu = makeCPUTracer();
  rates.cpu =
    rateOf(1.0, [&](int height) { cpu->render(scene, viewOf(height), settings, parallelFor); });

  scene.instances[0].visible = false; // VTK draws it
  settings.lightCode = true;
  const std::unique_ptr<Tracer> tracer = makeOpenGLTracer(makeCPUTracer());
  tracer->render(scene, viewOf(Heights[0]), settings, parallelFor);
  const LightCode& code = tracer->lightCode();
  ShadowMask mask;
  vtkOpenGLQuadHelper quad(window, nullptr, Places, nullptr);
  rates.openGL = rateOf(0.02,
    [&](int height)
    {
      if (quad.Program && mask.accepts(code) &&
        &mask.lookUp(code, Width, height, false, settings.gpuMemoryLimit) != &code)
      {
        const auto draw = [&](int, int)
        {
          window->GetShaderCache()->ReadyShaderProgram(quad.Program);
          quad.Render();
        };
        mask.find(window->GetState(), code, false, draw);
        glFinish();
      }
      else
      {
        rates.complaint = "OpenGL has no room for rays to lights, or refuses their shader.";
      }
    });
  quad.ReleaseGraphicsResources(window);
  mask.release();
  tracer->releaseGraphicsResources();
  return rates;
}

BackendChoice chooseBackend(vtkOpenGLRenderWindow* window, const std::string& renderer, bool rays,
  const std::function<RayRates()>& measure)
{
  if (renderer.empty() || isSoftwareRenderer(renderer))
  {
    return {};
  }
  if (!rays)
  {
    return { true, {} };
  }
  static std::vector<std::pair<vtkWeakPointer<vtkOpenGLState>, BackendChoice>> known;
  eraseIf(known, [](const auto& context) { return !context.first; });
  const auto found = std::find_if(known.begin(), known.end(),
    [window](const auto& context) { return context.first == window->GetState(); });
  if (found != known.end())
  {
    return found->second;
  }
  const RayRates rates = measure();
  known.push_back({ window->GetState(),
    { rates.complaint.empty() && rates.openGL >= rates.cpu, rates.complaint } });
  return known.back().second;
}

BackendChoice chooseBackend(
  vtkOpenGLRenderWindow* window, bool rays, const std::function<RayRates()>& measure)
{
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return chooseBackend(window, name ? name : "", rays, measure);
}
}
