// Meshes by the hundred, open, not manifold and broken ones among them: none crashes, none hangs,
// and of what VTK's raster draws nothing is missing.
//
//   TestManyMeshes [--pictures folder] [mesh file or folder]...
//
// Without arguments, generated meshes. Of each mesh two pictures are taken with each leaf geometry
// and compared with VTK's raster. A pixel that the raster draws is missed if nothing is traced
// there; at an outline, where a neighbour is not drawn, the two may round differently: those pixels
// are counted apart.
#include "svoTestPicture.h"
#include "svoTestStage.h"

#include "loaders.h"

#include "vtkAppendPolyData.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkConeSource.h"
#include "vtkCylinderSource.h"
#include "vtkMinimalStandardRandomSequence.h"
#include "vtkPNGWriter.h"
#include "vtkParametricFunctionSource.h"
#include "vtkParametricMobius.h"
#include "vtkPlaneSource.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkReverseSense.h"
#include "vtkSphereSource.h"
#include "vtkTrivialProducer.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <unistd.h>

namespace
{
using namespace svotest;
namespace fs = std::filesystem;

constexpr int Size = 320;
constexpr unsigned Seconds = 120; // a mesh that takes longer is taken to hang

std::string PictureFolder;
char Running[512];

extern "C" void reportHang(int)
{
  const ssize_t ignored =
    write(STDERR_FILENO, "Hangs: ", 7) + write(STDERR_FILENO, Running, std::strlen(Running));
  (void)ignored;
  std::_Exit(1);
}

struct Counts
{
  std::size_t drawn = 0;
  std::size_t missed = 0;       // inside of what the raster draws
  std::size_t missedBorder = 0; // at its outline
  std::size_t tooMuch = 0;      // traced more than a pixel away from what the raster draws
};

Counts compare(const Picture& raster, const Picture& traced)
{
  Counts counts;
  for (int y = 0; y < raster.height; ++y)
  {
    for (int x = 0; x < raster.width; ++x)
    {
      int drawn = 0, looked = 0;
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, raster.height - 1); ++j)
      {
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, raster.width - 1); ++i)
        {
          ++looked;
          drawn += raster.depth[static_cast<std::size_t>(j) * raster.width + i] < 1.0f;
        }
      }
      const std::size_t p = static_cast<std::size_t>(y) * raster.width + x;
      const bool inRaster = raster.depth[p] < 1.0f;
      const bool inTraced = traced.depth[p] < 1.0f;
      counts.drawn += inRaster;
      counts.missed += inRaster && !inTraced && drawn == looked;
      counts.missedBorder += inRaster && !inTraced && drawn != looked;
      counts.tooMuch += inTraced && drawn == 0;
    }
  }
  return counts;
}

void save(vtkRenderWindow* window, const std::string& name)
{
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  writer->SetFileName((PictureFolder + "/" + name + ".png").c_str());
  writer->Write();
}

void check(const std::string& name, vtkPolyData* mesh, Checks& checks)
{
  std::snprintf(Running, sizeof(Running), "%s\n", name.c_str());
  alarm(Seconds);
  double bounds[6];
  mesh->GetBounds(bounds);
  double middle[3], edge = 0.0;
  for (int a = 0; a < 3; ++a)
  {
    middle[a] = 0.5 * (bounds[2 * a] + bounds[2 * a + 1]);
    edge = std::max(edge, bounds[2 * a + 1] - bounds[2 * a]);
  }
  Stage stage(Size, Size);
  stage.addSun(2.0, -1.5, 4.0);
  stage.pass->SetMaximumLevel(9);
  stage.pass->SetPixelError(0.0);
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(mesh);
  vtkActor* actor = stage.add(producer, 0.9, 0.7, 0.5);
  const double scale = edge > 0.0 && std::isfinite(edge) ? 2.0 / edge : 1.0;
  if (std::isfinite(middle[0] + middle[1] + middle[2]))
  {
    actor->SetOrigin(middle);
    actor->SetPosition(-middle[0], -middle[1], -middle[2]);
    actor->SetScale(scale);
  }
  vtkCamera* camera = stage.renderer->GetActiveCamera();
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  Counts all[3];
  for (int side = 0; side < 2; ++side)
  {
    side == 0 ? camera->SetPosition(1.5, -3.5, 2.0) : camera->SetPosition(-4.2, 0.5, -1.0);
    camera->SetClippingRange(0.5, 12.0);
    stage.pass->SetShadowTechniqueToNone();
    stage.usePass(false);
    const Picture raster = capture(stage.window);
    stage.usePass(true);
    for (int leaf = 0; leaf < 3; ++leaf)
    {
      stage.pass->SetLeafGeometry(leaf); // voxel, plane, triangle
      const Picture traced = capture(stage.window);
      const Counts c = compare(raster, traced);
      all[leaf].drawn += c.drawn;
      all[leaf].missed += c.missed;
      all[leaf].missedBorder += c.missedBorder;
      all[leaf].tooMuch += c.tooMuch;
      if (!PictureFolder.empty() && leaf == 2 && side == 0)
      {
        save(stage.window, name);
      }
    }
    stage.shadowed(); // with a shadow buffer nothing may go wrong either
  }
  alarm(0);
  const char* const leaves[] = { "cubes", "planes", "triangles" };
  std::printf("%s: %lld triangles, %zu pixels; missed inside/outline:", name.c_str(),
    static_cast<long long>(mesh->GetNumberOfPolys()), all[0].drawn);
  for (int leaf = 0; leaf < 3; ++leaf)
  {
    std::printf(" %s %zu/%zu", leaves[leaf], all[leaf].missed, all[leaf].missedBorder);
    checks.expect(all[leaf].missed == 0, name + ": no pixel is missed by " + leaves[leaf]);
  }
  std::printf("; too much by triangles %zu\n", all[2].tooMuch);
  // Of triangles thinner than a pixel a raster, which moves vertices to 1/256 of one, leaves out
  // pixels that a ray hits.
  checks.expect(
    all[2].tooMuch <= all[2].drawn / 500 + 1, name + ": triangles are where the raster has them");
  std::fflush(stdout);
}

vtkSmartPointer<vtkPolyData> outputOf(vtkAlgorithm* source)
{
  source->Update();
  vtkSmartPointer<vtkPolyData> mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->DeepCopy(source->GetOutputDataObject(0));
  return mesh;
}

/// Triangles anywhere, of an aspect up to `aspect`.
vtkSmartPointer<vtkPolyData> soup(int count, double aspect)
{
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(5);
  const auto value = [&]
  {
    random->Next();
    return random->GetRangeValue(-1.0, 1.0);
  };
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  for (int i = 0; i < count; ++i)
  {
    const double at[3] = { value(), value(), value() };
    vtkIdType ids[3];
    for (int k = 0; k < 3; ++k)
    {
      const double size = 0.4 / (k == 2 ? aspect : 1.0);
      const double* from = k == 2 ? points->GetPoint(ids[1]) : at;
      const double base[3] = { from[0], from[1], from[2] };
      ids[k] = points->InsertNextPoint(
        base[0] + size * value(), base[1] + size * value(), base[2] + size * value());
    }
    triangles->InsertNextCell(3, ids);
  }
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  return mesh;
}

void checkGenerated(Checks& checks)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetThetaResolution(60);
  ball->SetPhiResolution(40);
  vtkNew<vtkReverseSense> inverted;
  inverted->SetInputConnection(ball->GetOutputPort());
  inverted->ReverseNormalsOn();
  vtkNew<vtkAppendPolyData> thrice;
  for (int i = 0; i < 3; ++i)
  {
    thrice->AddInputConnection(i < 2 ? ball->GetOutputPort() : inverted->GetOutputPort());
  }
  vtkNew<vtkPlaneSource> plane;
  plane->SetNormal(0.2, -0.7, 0.6);
  vtkNew<vtkParametricMobius> strip;
  vtkNew<vtkParametricFunctionSource> mobius;
  mobius->SetParametricFunction(strip);
  vtkNew<vtkCylinderSource> open;
  open->CappingOff();
  open->SetResolution(24);
  vtkNew<vtkConeSource> cone;
  cone->SetResolution(3);
  cone->SetHeight(4.0);
  cone->SetRadius(0.05);
  check("a sphere", outputOf(ball), checks);
  check("a sphere inside out", outputOf(inverted), checks);
  check("a sphere thrice, once inside out", outputOf(thrice), checks);
  check("a plane at a slant", outputOf(plane), checks);
  check("a Moebius strip", outputOf(mobius), checks);
  check("an open cylinder", outputOf(open), checks);
  check("a spike", outputOf(cone), checks);
  check("a soup of triangles", soup(400, 1.0), checks);
  check("a soup of thin triangles", soup(400, 30.0), checks);
}

/// While it lives, the process can get this much more memory. One of the broken files says that it
/// has 3.5e11 vertices, and the reader asks for them.
class MemoryLimit
{
public:
  explicit MemoryLimit(std::size_t more)
  {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    getrlimit(RLIMIT_AS, &this->Before);
    rlimit limit = this->Before;
    limit.rlim_cur = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + more;
    setrlimit(RLIMIT_AS, &limit);
  }
  ~MemoryLimit() { setrlimit(RLIMIT_AS, &this->Before); }

private:
  rlimit Before;
};

vtkSmartPointer<vtkPolyData> read(const std::string& path, std::string& error)
{
  const MemoryLimit limit(std::size_t(2) << 30);
  try
  {
    return paper::readTriangles(path, 0, error);
  }
  catch (const std::bad_alloc&)
  {
    error = "there is not enough memory for what it says it holds";
    return nullptr;
  }
}

void checkFile(const fs::path& path, Checks& checks, int& shown, int& refused)
{
  std::snprintf(Running, sizeof(Running), "%s\n", path.c_str());
  alarm(Seconds);
  std::string error;
  const auto mesh = read(path.string(), error);
  alarm(0);
  if (!mesh)
  {
    ++refused;
    std::printf("%s: refused by the reader: %s\n", path.filename().c_str(), error.c_str());
    std::fflush(stdout);
    return;
  }
  ++shown;
  check(path.filename().string(), mesh, checks);
}
}

int main(int argc, char* argv[])
{
  std::signal(SIGALRM, reportHang);
  Checks checks;
  std::vector<fs::path> files;
  bool named = false;
  for (int i = 1; i < argc; ++i)
  {
    if (std::string(argv[i]) == "--pictures" && i + 1 < argc)
    {
      PictureFolder = argv[++i];
      continue;
    }
    named = true;
    if (fs::is_directory(argv[i]))
    {
      for (const fs::directory_entry& entry : fs::directory_iterator(argv[i]))
      {
        files.push_back(entry.path());
      }
    }
    else
    {
      files.emplace_back(argv[i]);
    }
  }
  if (!named)
  {
    checkGenerated(checks);
    return checks.exitCode();
  }
  std::sort(files.begin(), files.end());
  int shown = 0, refused = 0;
  for (const fs::path& file : files)
  {
    checkFile(file, checks, shown, refused);
  }
  std::printf("%d meshes shown, %d files refused by the reader\n", shown, refused);
  checks.expect(shown > 0, "there is a mesh");
  return checks.exitCode();
}
