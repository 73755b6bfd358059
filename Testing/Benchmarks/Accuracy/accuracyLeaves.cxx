// Octree levels and leaf geometries: depth, silhouette, normals.
#include "accuracyExperiments.h"
#include "accuracyImages.h"

#include "svoSMPParallel.h"
#include "svoWorldSize.h"

namespace accuracy
{
const std::vector<std::pair<svo::LeafGeometry, const char*>> LeafGeometries{
  { svo::LeafGeometry::Voxel, "voxel" }, { svo::LeafGeometry::Plane, "plane" },
  { svo::LeafGeometry::Triangle, "triangle" }, { svo::LeafGeometry::Automatic, "automatic" }
};

Picture traced(
  const svo::Scene& scene, const svo::View& view, svo::FrameSettings settings, int repeat, Row& row)
{
  settings.frameCoherence = false;
  svo::CPUTracer tracer;
  double least = 0.0;
  for (int i = 0; i < repeat; ++i)
  {
    const double begin = processorSeconds();
    tracer.render(scene, view, settings, svo::smpParallelFor());
    const double seconds = processorSeconds() - begin;
    if (i == 0 || seconds < least)
    {
      least = seconds;
      row["processorMs"] = 1e3 * seconds;
      row["traceMs"] = 1e3 * tracer.statistics().traceTime;
      row["shadowMs"] = 1e3 * tracer.statistics().shadowTime;
    }
  }
  return pictureOf(tracer.frame(), scene, view);
}

void measureLeaves(const Sweep& sweep, Results& results)
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
    for (const int level : sweep.levels)
    {
      const OctreeShelf::Entry& built = shelf.get(*shape, level);
      shelf.keepLevel(level);
      for (const auto& [leaves, name] : LeafGeometries)
      {
        Row row;
        row["experiment"] = "leaves";
        row["mesh"] = stage.name;
        row["closed"] = shape->closed;
        row["level"] = level;
        row["leaves"] = name;
        row["buildMs"] = 1e3 * built.buildSeconds;
        row["octreeKiB"] = static_cast<double>(built.octree.bytes()) / 1024.0;
        const svo::Scene scene = sceneOf(stage, shelf, level, leaves);
        svo::FrameSettings settings;
        settings.shadowTechnique = svo::ShadowTechnique::None;
        settings.pixelError = 0.0;
        const Picture picture = traced(scene, view, settings, sweep.repeat, row);
        measureDepth(picture, truth, view, svo::worldVoxel(scene.instances[0]), row);
        measureSilhouette(picture, truth, reference, view, row);
        results.add(row);
        if (!sweep.images.empty() && level == 10)
        {
          writeDepthDifference(picture, truth, view, svo::worldVoxel(scene.instances[0]),
            sweep.images + "/depth-" + stage.name + "-" + name + ".png");
        }
      }
    }
  }
}
}
