// The promise of the pixel error: how far points are displaced on the screen.
#include "accuracyExperiments.h"

#include "svoSMPParallel.h"
#include "svoSelectLevel.h"
#include "svoWorldSize.h"

#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace accuracy
{
namespace
{
/// Pixels between the centre of a pixel and where the mesh's point that is nearest to the pixel's
/// hit is seen; every third pixel of every third row.
std::vector<double> displacements(
  const Picture& picture, const svo::View& view, const Object& object)
{
  constexpr int Step = 3;
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(object.shape->data);
  locator->BuildLocator();
  const glm::dmat4 toClip = view.viewToClip * view.worldToView;
  std::vector<double> all(static_cast<std::size_t>(view.width) * view.height, -1.0);
  const int rows = view.height / Step;
  svo::smpParallelFor()(0, rows, 4,
    [&](std::size_t begin, std::size_t end)
    {
      vtkNew<vtkGenericCell> cell;
      for (int y = Step * static_cast<int>(begin); y < Step * static_cast<int>(end); y += Step)
      {
        for (int x = 0; x < view.width; x += Step)
        {
          const std::size_t i = static_cast<std::size_t>(y) * view.width + x;
          if (!picture.hit(i))
          {
            continue;
          }
          const double t = linearDepth(view, picture.depth[i]);
          const glm::dvec3 hit =
            view.rayOrigin(x + 0.5, y + 0.5) + t * view.rayDirection(x + 0.5, y + 0.5);
          double nearest[3], distance2;
          vtkIdType id;
          int sub;
          locator->FindClosestPoint(&hit.x, nearest, cell, id, sub, distance2);
          const glm::dvec4 clip = toClip * glm::dvec4(nearest[0], nearest[1], nearest[2], 1.0);
          all[i] = std::hypot((clip.x / clip.w + 1.0) * 0.5 * view.width - (x + 0.5),
            (clip.y / clip.w + 1.0) * 0.5 * view.height - (y + 0.5));
        }
      }
    });
  all.erase(std::remove_if(all.begin(), all.end(), [](double d) { return d < 0.0; }), all.end());
  return all;
}
}

void measurePixelError(const Sweep& sweep, Results& results)
{
  for (const auto& shape : sweep.shapes)
  {
    Stage stage;
    stage.name = shape->mesh.name;
    stage.objects = { { shape, glm::dmat4(1.0) } };
    stage.camera.width = stage.camera.height = sweep.size;
    stage.camera.eye = { 0.8, -2.0, 0.9 };
    fillWindow(stage, stage.objects[0]);
    fitClippingPlanes(stage);
    const svo::View view = stage.camera.view();
    const Reference reference(stage);
    const std::vector<TruePixel> truth = exactPicture(reference, stage, view, false);
    OctreeShelf shelf;
    const int deepest = sweep.pixelErrorLevel;
    for (const auto& [leaves, name] : LeafGeometries)
    {
      if (leaves == svo::LeafGeometry::Plane || leaves == svo::LeafGeometry::Triangle)
      {
        continue; // above the bricks all but cubes are mean planes
      }
      const svo::Scene scene = sceneOf(stage, shelf, deepest, leaves);
      const svo::Instance& instance = scene.instances[0];
      const svo::LocalView local =
        svo::makeLocalView(instance.body->octree, instance.localToWorld, view);
      for (const double pixels : sweep.pixelErrors)
      {
        const int level = svo::selectLevel(instance, local, view, pixels);
        Row row;
        row["experiment"] = "pixelError";
        row["mesh"] = stage.name;
        row["leaves"] = name;
        row["pixelError"] = pixels;
        row["level"] = level;
        row["deepest"] = deepest;
        row["voxelPixels"] = svo::worldVoxel(instance, level) / svo::worldPixel(view, local.base);
        svo::FrameSettings settings;
        settings.shadowTechnique = svo::ShadowTechnique::None;
        settings.pixelError = pixels;
        const Picture picture = traced(scene, view, settings, sweep.repeat, row);
        const std::vector<double> moved = displacements(picture, view, stage.objects[0]);
        const double promised = std::sqrt(3.0) * pixels;
        row["promisedPixels"] = promised;
        row["beyondPromise"] = static_cast<double>(std::count_if(moved.begin(), moved.end(),
                                 [&](double d) { return d > promised; })) /
          static_cast<double>(std::max<std::size_t>(moved.size(), 1));
        Distribution(moved).write(row, "moved");
        measureDepth(picture, truth, view, svo::worldVoxel(instance, level), row);
        measureSilhouette(picture, truth, reference, view, row);
        results.add(row);
      }
    }
  }
}
}
