// Smoothed edges against the mean of 64 exact rays a pixel, in error and in time.
#include "accuracyExperiments.h"

#include "svoSMPParallel.h"

#include <algorithm>
#include <cmath>

namespace accuracy
{
namespace
{
constexpr int Finer = 8;

struct Mean
{
  double grey = 0.0;   // 0..255
  bool edge = false;   // the rays differ by more than a twentieth of white
  bool shadow = false; // some rays end in shadow, some in light
  bool inside = false; // all rays hit something
};

std::vector<Mean> meanPicture(const Stage& stage, const Reference& reference)
{
  Camera fine = stage.camera;
  fine.width *= Finer;
  fine.height *= Finer;
  const svo::View view = fine.view();
  const svo::Light& light = stage.lights[0];
  const int width = stage.camera.width, height = stage.camera.height;
  std::vector<Mean> means(static_cast<std::size_t>(width) * height);
  svo::smpParallelFor()(0, means.size(), 256,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        const int x0 = Finer * static_cast<int>(i % width);
        const int y0 = Finer * static_cast<int>(i / width);
        double sum = 0.0, low = 1.0, high = 0.0;
        int hits = 0, blocked = 0, reached = 0;
        for (int k = 0; k < Finer * Finer; ++k)
        {
          const ExactHit hit = reference.first(view, x0 + k % Finer + 0.5, y0 + k / Finer + 0.5);
          if (!hit)
          {
            continue;
          }
          ++hits;
          double lit = std::max(0.0, glm::dot(hit.normal, towards(light, hit.point)));
          if (lit > 0.0 && reference.blocked(hit.point, hit.normal, light))
          {
            lit = 0.0;
            ++blocked;
          }
          reached += lit > 0.0;
          sum += lit;
          low = std::min(low, lit);
          high = std::max(high, lit);
        }
        Mean& mean = means[i];
        mean.inside = hits == Finer * Finer;
        mean.grey = hits ? 255.0 * sum / hits : 0.0;
        mean.edge = high - low > 0.05;
        mean.shadow = blocked > 0 && reached > 0;
      }
    });
  return means;
}

struct MeanSquare
{
  double sum = 0.0;
  std::size_t count = 0;
  void add(double error, bool counts)
  {
    sum += counts ? error * error : 0.0;
    count += counts;
  }
  double root() const
  {
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(count, 1)));
  }
};

/// Nothing; more rays at edges alone; what SetAntiAliasing does: filtered shadows, too.
struct Variant
{
  svo::ShadowTechnique technique;
  bool antiAliasing;
  bool filterShadows;
};
const Variant Ways[] = { { svo::ShadowTechnique::Buffer, false, false },
  { svo::ShadowTechnique::Buffer, true, false }, { svo::ShadowTechnique::Buffer, true, true },
  { svo::ShadowTechnique::Rays, false, false }, { svo::ShadowTechnique::Rays, true, false } };

std::vector<int> resolutionsOf(svo::ShadowTechnique technique)
{
  return technique == svo::ShadowTechnique::Rays ? std::vector<int>{ 0 }
                                                 : std::vector<int>{ 256, 512, 1024, 2048 };
}
}

void measureAntiAliasing(const Sweep& sweep, Results& results)
{
  for (const auto& shape : sweep.shapes)
  {
    Stage stage = groundStage(shape, sweep.size / 2);
    stage.lights = { lightsAround()[2].second };
    const svo::View view = stage.camera.view();
    const Reference reference(stage);
    const std::vector<Mean> means = meanPicture(stage, reference);
    OctreeShelf shelf;
    const svo::Scene scene = sceneOf(stage, shelf, 10, svo::LeafGeometry::Automatic);
    for (const Variant& way : Ways)
    {
      for (const int resolution : resolutionsOf(way.technique))
      {
        Row row;
        row["experiment"] = "antiAliasing";
        row["mesh"] = stage.name;
        row["technique"] = way.technique == svo::ShadowTechnique::Rays ? "rays" : "buffer";
        row["resolution"] = resolution;
        row["antiAliasing"] = way.antiAliasing;
        row["filterShadows"] = way.filterShadows;
        svo::FrameSettings settings;
        settings.shadowTechnique = way.technique;
        settings.shadowResolution = resolution;
        settings.antiAliasing = way.antiAliasing;
        settings.filterShadows = way.filterShadows;
        const Picture picture = traced(scene, view, settings, sweep.repeat, row);
        MeanSquare all, edges, shadows;
        for (std::size_t i = 0; i < means.size(); ++i)
        {
          if (means[i].inside && picture.hit(i))
          {
            const double error = picture.grey[i] - means[i].grey;
            all.add(error, true);
            edges.add(error, means[i].edge);
            shadows.add(error, means[i].shadow);
          }
        }
        row["edgePixels"] = static_cast<Json::UInt64>(edges.count);
        row["edgeRms"] = edges.root();
        row["shadowEdgePixels"] = static_cast<Json::UInt64>(shadows.count);
        row["shadowEdgeRms"] = shadows.root();
        row["rms"] = all.root();
        results.add(row);
      }
    }
  }
}
}
