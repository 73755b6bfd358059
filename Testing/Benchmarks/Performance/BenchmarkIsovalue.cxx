// What a new picture costs while the value of an isosurface is dragged: flying edges and VTK's
// rasteriser, without shadows and with vtkShadowMapPass; flying edges and vtkSVORenderPass, which
// makes an octree of its triangles; and vtkImageToSVO, without triangles. The methods take turns at
// each value. Medians over the values of processor time and wall time, in ms; of ours also the time
// to the surface alone. The picture of each method is compared with that of its like: the share of
// pixels that differ by more than 24 of 255.
//
//   BenchmarkIsovalue [--sizes 128,256] [--values n] [--size 1280x720] [--json file] [--pictures
//   prefix]
#include "performanceWindow.h"
#include "svoResults.h"
#include "vtkImageToSVO.h"
#include "vtkSVORenderPass.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <sstream>
#include <string>
#include <vector>

namespace
{
struct Moment
{
  double processor = 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  std::chrono::steady_clock::time_point clock = std::chrono::steady_clock::now();
  double wall(const Moment& since) const
  {
    return std::chrono::duration<double, std::milli>(this->clock - since.clock).count();
  }
};

/// Of a ball with waves all over, 2 wide: values fall outwards, as densities do.
vtkSmartPointer<vtkImageData> density(int points)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(points, points, points);
  const double spacing = 2.4 / (points - 1);
  image->SetSpacing(spacing, spacing, spacing);
  image->SetOrigin(-1.2, -1.2, -1.2);
  vtkNew<vtkFloatArray> values;
  values->SetNumberOfValues(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double x[3];
    image->GetPoint(i, x);
    const double waves = std::sin(9.0 * x[0]) * std::sin(8.0 * x[1]) +
      std::sin(7.0 * x[2] + 1.0) * std::sin(6.0 * x[0]);
    values->SetValue(i, static_cast<float>(1.0 - std::hypot(x[0], x[1], x[2]) + 0.12 * waves));
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

enum class Surface
{
  Triangles,
  Octree
};
enum class Look
{
  Raster,
  ShadowMaps,
  Traced,
  TracedWithShadows
};

/// One way to draw it, in a window of its own.
class Method
{
public:
  Method(const std::string& name, Surface surface, int deeper, Look look, vtkImageData* image,
    const int size[2])
    : Name(name)
    , Kind(surface)
  {
    int level = 0;
    while ((1 << level) < image->GetDimensions()[0] - 1)
    {
      ++level;
    }
    this->Triangles->SetInputData(image);
    this->Triangles->ComputeScalarsOff();
    this->Octree->SetInputData(image);
    this->Octree->SetMaximumLevel(level + deeper);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(this->source()->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-3.0, -3.0, -1.3);
    plane->SetPoint1(3.0, -3.0, -1.3);
    plane->SetPoint2(-3.0, 3.0, -1.3);
    vtkNew<vtkPolyDataMapper> planeMapper;
    planeMapper->SetInputConnection(plane->GetOutputPort());
    vtkNew<vtkActor> ground;
    ground->SetMapper(planeMapper);
    this->Renderer->AddActor(actor);
    this->Renderer->AddActor(ground);
    vtkNew<vtkLight> sun;
    sun->SetPosition(3.0, -2.0, 5.0);
    sun->SetFocalPoint(0.0, 0.0, 0.0);
    this->Renderer->AddLight(sun);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(3.0, -5.0, 3.0);
    camera->SetFocalPoint(0.0, 0.0, -0.3);
    camera->SetViewUp(0.0, 0.0, 1.0);
    camera->SetClippingRange(2.0, 15.0);
    this->Window->SetOffScreenRendering(true);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(size[0], size[1]);
    this->Window->AddRenderer(this->Renderer);
    this->setLook(look);
  }
  ~Method() { this->Window->Finalize(); }

  /// A new value, and the picture of it.
  void draw(double value)
  {
    const Moment start;
    this->Triangles->SetValue(0, value);
    this->Octree->SetValue(value);
    this->source()->Update();
    const Moment surface;
    this->Window->Render();
    int size[2] = { this->Window->GetSize()[0], this->Window->GetSize()[1] };
    this->Window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, this->Pixels); // waits for it
    const Moment end;
    this->SurfaceProcessor.push_back(surface.processor - start.processor);
    this->SurfaceWall.push_back(surface.wall(start));
    this->Processor.push_back(end.processor - start.processor);
    this->Wall.push_back(end.wall(start));
  }
  /// Of the warming up.
  void forget()
  {
    for (auto* times : { &SurfaceProcessor, &SurfaceWall, &Processor, &Wall })
    {
      times->clear();
    }
  }
  double differing(const Method& other) const
  {
    vtkIdType pixels = 0;
    const vtkIdType n = this->Pixels->GetNumberOfTuples();
    for (vtkIdType i = 0; i < n; ++i)
    {
      int most = 0;
      for (int k = 0; k < 3; ++k)
      {
        most = std::max(most,
          std::abs(int(this->Pixels->GetTypedComponent(i, k)) -
            int(other.Pixels->GetTypedComponent(i, k))));
      }
      pixels += most > 24;
    }
    return static_cast<double>(pixels) / static_cast<double>(n);
  }
  void write(const std::string& path) { performance::writePicture(this->Window, path); }
  svobench::Row row(int points, double worst) const
  {
    svobench::Row row;
    row["experiment"] = "isovalue";
    row["points"] = points;
    row["method"] = this->Name;
    row["processorMs"] = performance::median(this->Processor);
    row["wallMs"] = performance::median(this->Wall);
    row["surfaceProcessorMs"] = performance::median(this->SurfaceProcessor);
    row["surfaceWallMs"] = performance::median(this->SurfaceWall);
    row["differingShare"] = worst;
    return row;
  }
  const std::string Name;

private:
  vtkAlgorithm* source()
  {
    return this->Kind == Surface::Octree ? static_cast<vtkAlgorithm*>(this->Octree)
                                         : this->Triangles;
  }
  void setLook(Look look)
  {
    if (look == Look::ShadowMaps)
    {
      performance::useShadowMaps(this->Renderer);
    }
    else if (look != Look::Raster)
    {
      vtkNew<vtkSVORenderPass> pass;
      look == Look::Traced ? pass->SetShadowTechniqueToNone()
                           : pass->SetShadowTechniqueToShadowBuffer();
      this->Renderer->SetPass(pass);
    }
  }

  const Surface Kind;
  vtkNew<vtkFlyingEdges3D> Triangles;
  vtkNew<vtkImageToSVO> Octree;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkUnsignedCharArray> Pixels;
  std::vector<double> SurfaceProcessor, SurfaceWall, Processor, Wall;
};

/// False if two pictures of the same look are not alike.
bool measure(int points, int values, const int size[2], const std::string& pictures,
  svobench::Results& results)
{
  const auto image = density(points);
  // Each after the one that it has to look like.
  Method raster("flying edges, raster", Surface::Triangles, 0, Look::Raster, image, size);
  Method unlit("image, traced", Surface::Octree, 0, Look::Traced, image, size);
  Method unlitFine("image, a level more, traced", Surface::Octree, 1, Look::Traced, image, size);
  Method maps(
    "flying edges, vtkShadowMapPass", Surface::Triangles, 0, Look::ShadowMaps, image, size);
  Method traced(
    "flying edges, traced, shadows", Surface::Triangles, 0, Look::TracedWithShadows, image, size);
  Method ours("image, traced, shadows", Surface::Octree, 0, Look::TracedWithShadows, image, size);
  Method fine("image, a level more, traced, shadows", Surface::Octree, 1, Look::TracedWithShadows,
    image, size);
  struct Turn
  {
    Method* method;
    const Method* like;
    double worst;
  };
  std::vector<Turn> turns{ { &raster, nullptr, 0.0 }, { &unlit, &raster, 0.0 },
    { &unlitFine, &raster, 0.0 }, { &traced, nullptr, 0.0 }, { &maps, &traced, 0.0 },
    { &ours, &traced, 0.0 }, { &fine, &traced, 0.0 } };
  for (int i = -1; i < values; ++i) // the first warms up
  {
    for (Turn& turn : turns)
    {
      turn.method->draw(-0.05 + 0.3 * (i + 1) / values);
      turn.worst =
        turn.like ? std::max(turn.worst, turn.method->differing(*turn.like)) : turn.worst;
      if (i < 0)
      {
        turn.method->forget();
      }
    }
  }
  bool good = true;
  for (Turn& turn : turns)
  {
    results.add(turn.method->row(points, turn.worst));
    if (!pictures.empty())
    {
      std::string name = turn.method->Name;
      std::replace(name.begin(), name.end(), ' ', '-');
      turn.method->write(pictures + std::to_string(points) + "-" + name + ".png");
    }
    // VTK's shadow maps are a way of their own to draw shadows; of ours outlines may differ.
    constexpr double Alike = 0.02;
    good = good && (turn.method == &maps || turn.worst <= Alike);
  }
  return good;
}
}

int main(int argc, char** argv)
{
  std::vector<int> points{ 128, 256 };
  int values = 9, size[2] = { 1280, 720 };
  std::string json, pictures;
  for (int i = 1; i + 1 < argc; i += 2)
  {
    const std::string name = argv[i], argument = argv[i + 1];
    if (name == "--sizes")
    {
      points.clear();
      std::istringstream list(argument);
      for (std::string one; std::getline(list, one, ',');)
      {
        points.push_back(std::max(std::atoi(one.c_str()), 8));
      }
    }
    else if (name == "--values")
    {
      values = std::max(std::atoi(argument.c_str()), 1);
    }
    else if (name == "--size")
    {
      std::sscanf(argument.c_str(), "%dx%d", &size[0], &size[1]);
    }
    else if (name == "--json")
    {
      json = argument;
    }
    else if (name == "--pictures")
    {
      pictures = argument;
    }
    else
    {
      std::fprintf(stderr, "BenchmarkIsovalue: what is %s?\n", name.c_str());
      return 1;
    }
  }
  svobench::Results results(
    { "points", "method", "processorMs", "wallMs", "surfaceProcessorMs", "differingShare" });
  bool good = true;
  for (const int n : points)
  {
    good = measure(n, values, size, pictures, results) && good;
  }
  if (!json.empty() && !results.writeJson(json))
  {
    std::fprintf(stderr, "BenchmarkIsovalue: cannot write %s\n", json.c_str());
    return 1;
  }
  if (!good)
  {
    std::fprintf(stderr, "BenchmarkIsovalue: pictures that should be alike are not\n");
  }
  return good ? 0 : 1;
}
