// In a window with multisampling, edges of traced surfaces are as smooth as those of VTK's own
// raster: silhouettes in front of the background, of each other and of a rasterised surface,
// however the surface is traced, and edges between facets.
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkPlaneSource.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataToSVO.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkTrivialProducer.h"
#include "vtkTubeFilter.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

namespace
{
using namespace svotest;

void fill(Stage& stage)
{
  stage.addGround(1.6);
  stage.add(ball(0.7, -0.6, -0.2, 0.9), 0.9, 0.5, 0.3);
  stage.add(ring(0.7, 0.6, 0.4, 0.9), 0.3, 0.6, 0.9);
  // Edges on: the rasteriser's.
  stage.add(box(0.9, 0.0, 1.3, 1.3), 0.5, 0.9, 0.4)->GetProperty()->EdgeVisibilityOn();
  stage.addSun(2.0, -1.5, 4.0);
  stage.pass->SetShadowTechniqueToNone();
  stage.pass->SetPixelError(0.0);
}

/// Pixels where the two pictures differ by more than `levels` in a channel.
std::size_t different(const Picture& a, const Picture& b, int levels)
{
  std::size_t count = 0;
  for (std::size_t pixel = 0; pixel < a.size(); ++pixel)
  {
    int largest = 0;
    for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c)
    {
      largest = std::max(largest, std::abs(int(a.rgb[c]) - int(b.rgb[c])));
    }
    count += largest > levels;
  }
  return count;
}

vtkSmartPointer<vtkAlgorithm> finely(double radius)
{
  auto source = vtkSmartPointer<vtkSphereSource>::New();
  source->SetThetaResolution(250);
  source->SetPhiResolution(250);
  source->SetRadius(radius);
  return source;
}

vtkSmartPointer<vtkAlgorithm> converted(vtkAlgorithm* source, int level)
{
  auto toOctree = vtkSmartPointer<vtkPolyDataToSVO>::New();
  toOctree->SetInputConnection(source->GetOutputPort());
  toOctree->SetMaximumLevel(level);
  return toOctree;
}

/// A bumpy sheet without normals: every triangle is seen.
vtkSmartPointer<vtkAlgorithm> sheet(int resolution)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(resolution, resolution);
  plane->Update();
  vtkNew<vtkPolyData> mesh;
  mesh->CopyStructure(plane->GetOutput());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double x[3];
    mesh->GetPoint(i, x);
    x[2] = 0.05 * std::sin(9.0 * x[0]) * std::cos(7.0 * x[1]) + 0.02 * std::sin(40.0 * x[0]) +
      0.005 * std::sin(170.0 * x[1] + 30.0 * x[0]);
    mesh->GetPoints()->SetPoint(i, x);
  }
  auto producer = vtkSmartPointer<vtkTrivialProducer>::New();
  producer->SetOutput(mesh);
  return producer;
}

struct Pair
{
  Picture raster, traced;
};

/// The raster's picture and the traced one of a surface, with 4 samples a pixel and all settings
/// as they are by default.
template <class Change>
Pair picturesOf(vtkAlgorithm* source, Checks& checks, const Change& change, int level = 9)
{
  Stage stage;
  stage.renderer->SetBackground(0.0, 0.0, 0.0);
  stage.pass->SetMaximumLevel(level);
  stage.pass->SetShadowTechniqueToNone();
  stage.addSun(2.0, -1.5, 4.0);
  change(stage.add(source, 1.0, 1.0, 1.0));
  stage.window->SetMultiSamples(4);
  stage.renderer->ResetCamera();
  Pair pair;
  stage.usePass(false);
  pair.raster = capture(stage.window);
  stage.usePass(true);
  pair.traced = capture(stage.window);
  stage.expectTraced(checks, 1, "the surface is traced");
  return pair;
}

/// The outline of a white surface without lighting covers as much as the raster's.
void compareOutlines(const std::string& name, vtkAlgorithm* source, double flatness, Checks& checks)
{
  const Pair pair = picturesOf(source, checks,
    [&](vtkActor* actor)
    {
      actor->GetProperty()->LightingOff();
      actor->SetScale(1.0, 1.0, flatness);
    });
  double more = 0.0;
  std::size_t edges = 0;
  for (std::size_t i = 0; i < pair.raster.size(); ++i)
  {
    more += (pair.traced.grey(i) - pair.raster.grey(i)) / 255.0;
    edges += pair.raster.grey(i) > 0.0 && pair.raster.grey(i) < 255.0;
  }
  const std::size_t wrong = different(pair.raster, pair.traced, 16);
  std::cout << name << ": larger by " << more << " pixels; " << wrong << " differ, of " << edges
            << " edge pixels\n";
  checks.expect(edges > 200, name + ": there are edges");
  checks.expect(std::abs(more) < 0.02 * edges, name + ": no fatter and no thinner");
  checks.expect(wrong < edges / 20, name + ": its edge pixels are the raster's");
}

/// Samples are in the shadows that their pixels are in: what they make of a pixel lies between what
/// is seen around it without multisampling.
void compareShadows(const std::string& name, bool rays, Checks& checks)
{
  Stage stage;
  stage.addGround(2.5);
  stage.add(ball(0.7, -0.6, -0.2, 0.9), 0.9, 0.5, 0.3);
  stage.add(box(0.9, 0.7, 0.3, 0.45), 0.3, 0.6, 0.9);
  stage.addSun(2.0, -1.5, 4.0);
  stage.pass->SetShadowTechnique(
    rays ? vtkSVORenderPass::SHADOW_RAYS : vtkSVORenderPass::SHADOW_BUFFER);
  stage.usePass(true);
  const Picture plain = capture(stage.window);
  stage.window->SetMultiSamples(4);
  const Picture samples = capture(stage.window);
  std::size_t outside = 0;
  for (int y = 1; y + 1 < plain.height; ++y)
  {
    for (int x = 1; x + 1 < plain.width; ++x)
    {
      double least = 255.0, most = 0.0;
      for (int k = 0; k < 9; ++k)
      {
        const double grey = plain.grey(x + k % 3 - 1, y + k / 3 - 1);
        least = std::min(least, grey);
        most = std::max(most, grey);
      }
      outside += samples.grey(x, y) > most + 16.0 || samples.grey(x, y) < least - 16.0;
    }
  }
  std::cout << name << ": " << outside << " pixels are brighter or darker than all around them, "
            << different(plain, samples, 16) << " are smoothed\n";
  checks.expect(different(plain, samples, 16) > 400, name + ": edges are smoothed");
  checks.expect(outside < 8, name + ": samples are shadowed as their pixels are");
}

void compareFacets(int resolution, Checks& checks)
{
  const Pair pair = picturesOf(sheet(resolution), checks, [](vtkActor*) {});
  const std::size_t wrong = different(pair.raster, pair.traced, 10);
  std::cout << resolution << "^2 facets: " << wrong << " pixels differ\n";
  checks.expect(wrong < pair.raster.size() / 200, "facets are mixed as the raster does");
}

/// Bundles of thin tubes: at nearly every pixel triangles are seen whose interpolated normals count
/// at the pixel's centre, which lies beside them.
vtkSmartPointer<vtkAlgorithm> tubes()
{
  constexpr int Lines = 40, Points = 60;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  for (int line = 0; line < Lines; ++line)
  {
    lines->InsertNextCell(Points);
    for (int i = 0; i < Points; ++i)
    {
      const double turn = 0.2 * i + 1.7 * line, radius = 0.2 + 0.02 * line;
      lines->InsertCellPoint(points->InsertNextPoint(
        radius * std::cos(turn), radius * std::sin(turn), 0.03 * i + 0.011 * line));
    }
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetLines(lines);
  auto tube = vtkSmartPointer<vtkTubeFilter>::New();
  tube->SetInputData(mesh);
  tube->SetRadius(0.008);
  tube->SetNumberOfSides(6);
  return tube;
}

void compareTubes(Checks& checks)
{
  // Deep enough for rays to end on triangles.
  const Pair pair = picturesOf(
    tubes(), checks, [](vtkActor*) {}, 11);
  std::size_t covered = 0;
  for (std::size_t i = 0; i < pair.raster.size(); ++i)
  {
    covered += pair.raster.grey(i) > 0.0;
  }
  const std::size_t wrong = different(pair.raster, pair.traced, 10);
  std::cout << "tubes: " << wrong << " pixels differ of " << covered << "\n";
  checks.expect(covered > 10000, "tubes are seen");
  checks.expect(wrong < covered / 100, "normals are interpolated where the raster does");
}
}

int TestSVOMultiSamples(int argc, char* argv[])
{
  Checks checks;
  Stage stage;
  fill(stage);
  stage.window->SetMultiSamples(4);
  stage.usePass(false);
  const Picture raster = capture(stage.window);
  stage.usePass(true);
  const Picture traced = capture(stage.window);
  stage.expectTraced(checks, 3, "all but the box are traced");
  const bool same = matchesBaseline(stage.window, argc, argv);

  // The same without multisampling, for what an aliased edge is.
  Stage plain;
  fill(plain);
  plain.usePass(false);
  const Picture aliased = capture(plain.window);
  const std::size_t edges = different(raster, aliased, 16);
  const std::size_t wrong = different(raster, traced, 16);
  std::cout << edges << " pixels are smoothed by multisampling; " << wrong
            << " of the traced picture differ from the raster\n";
  checks.expect(edges > 500, "multisampling smooths edges");
  checks.expect(wrong < edges / 10, "nine smoothed pixels of ten are so in the traced picture");

  // Kept layers and a second frame change nothing.
  checks.expect(different(traced, capture(stage.window), 0) == 0, "two frames are equal");

  compareOutlines("fine ball", finely(1.0), 1.0, checks);
  compareOutlines("ring of level 7", converted(ring(1.0, 0.0, 0.0, 0.0), 7), 1.0, checks);
  compareOutlines("flattened ball", ball(1.0, 0.0, 0.0, 0.0), 1e-8, checks);
  compareTubes(checks);
  compareShadows("buffers", false, checks);
  compareShadows("rays", true, checks);
  compareFacets(30, checks);
  compareFacets(150, checks);
  return same ? checks.exitCode() : EXIT_FAILURE;
}
