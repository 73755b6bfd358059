#include "accuracyMetrics.h"

#include "svoReferencePoint.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace accuracy
{
namespace
{
constexpr float LitEnough = 0.05f;
constexpr int VisibleGrey = 8;

double quantile(std::vector<double>& values, double share)
{
  if (values.empty())
  {
    return 0.0;
  }
  const auto nth = values.begin() +
    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/// Hits of the four corners of a square around a point of the image.
template <class Hits>
int hitsAround(double half, double x, double y, const Hits& hit)
{
  return hit(x - half, y - half) + hit(x + half, y - half) + hit(x - half, y + half) +
    hit(x + half, y + half);
}

bool sameObject(const Picture& picture, std::size_t i, const TruePixel& p)
{
  return p.hit && picture.hit(i) && (picture.object.empty() || picture.object[i] == p.hit.object);
}
}

double linearDepth(const svo::View& view, double windowDepth)
{
  // The rows of the projection that make z and w; x and y take no part in either.
  const glm::dmat4& m = view.viewToClip;
  const double ndc = 2.0 * windowDepth - 1.0;
  return (m[3][2] - ndc * m[3][3]) / (m[2][2] - ndc * m[2][3]);
}

Picture pictureOf(const svo::Frame& frame, const svo::Scene& scene, const svo::View& view)
{
  Picture picture;
  picture.depth = frame.depth;
  const std::size_t pixels = frame.depth.size();
  picture.grey.resize(pixels);
  picture.object.assign(pixels, NoObject);
  picture.normal.assign(pixels, glm::vec3(0.0f));
  std::vector<svo::SurfaceMatrices> matrices(scene.instances.begin(), scene.instances.end());
  for (std::size_t i = 0; i < pixels; ++i)
  {
    picture.grey[i] = frame.color[4 * i];
    if (frame.instance[i] == ~0u)
    {
      picture.depth[i] = 1.0f;
      continue;
    }
    picture.depth[i] = std::min(frame.depth[i], 0.9999999f);
    picture.object[i] = static_cast<int>(frame.instance[i]);
    const double x = static_cast<double>(i % frame.width) + 0.5;
    const double y = static_cast<double>(i / frame.width) + 0.5;
    picture.normal[i] = svo::surfacePoint(matrices[frame.instance[i]], view, x, y,
      linearDepth(view, frame.depth[i]), frame.primitive[i])
                          .facet;
  }
  return picture;
}

Distribution::Distribution(std::vector<double> values)
  : count(values.size())
{
  this->signedMedian = quantile(values, 0.5);
  for (double& v : values)
  {
    v = std::abs(v);
  }
  this->median = quantile(values, 0.5);
  this->p95 = quantile(values, 0.95);
  this->p99 = quantile(values, 0.99);
  this->max = quantile(values, 1.0);
}

void Distribution::write(Row& row, const std::string& prefix) const
{
  row[prefix + "SignedMedian"] = this->signedMedian;
  row[prefix + "Median"] = this->median;
  row[prefix + "P95"] = this->p95;
  row[prefix + "P99"] = this->p99;
  row[prefix + "Max"] = this->max;
}

void measureDepth(const Picture& picture, const std::vector<TruePixel>& truth,
  const svo::View& view, double voxel, Row& row)
{
  constexpr float Bounds[] = { 0.0f, 0.1f, 0.2f, 0.4f, 0.7f, 1.01f };
  std::vector<double> ray, normal, angle, edge, grazing, byAngle[5];
  std::size_t beyondTwo = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    const TruePixel& p = truth[i];
    if (!sameObject(picture, i, p))
    {
      continue;
    }
    const double x = static_cast<double>(i % view.width) + 0.5;
    const double y = static_cast<double>(i / view.width) + 0.5;
    const double along = (linearDepth(view, picture.depth[i]) - p.hit.t) *
      glm::length(view.rayDirection(x, y)) / voxel;
    if (p.atEdge)
    {
      edge.push_back(along);
      continue;
    }
    for (int k = 0; k < 5; ++k)
    {
      if (p.facing >= Bounds[k] && p.facing < Bounds[k + 1])
      {
        byAngle[k].push_back(along);
      }
    }
    if (p.facing <= Grazing)
    {
      grazing.push_back(along);
      continue;
    }
    ray.push_back(along);
    normal.push_back(along * p.facing);
    beyondTwo += std::abs(along) > 2.0;
    if (!picture.normal.empty())
    {
      const double cosine = glm::dot(glm::dvec3(picture.normal[i]), p.hit.normal);
      angle.push_back(glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0))));
    }
  }
  row["pixels"] = static_cast<Json::UInt64>(ray.size());
  row["beyondTwoVoxels"] = static_cast<double>(beyondTwo) / std::max<std::size_t>(ray.size(), 1);
  Distribution(std::move(ray)).write(row, "ray");
  Distribution(std::move(normal)).write(row, "normal");
  Distribution(std::move(grazing)).write(row, "grazing");
  Distribution(std::move(edge)).write(row, "edge");
  if (!picture.normal.empty())
  {
    Distribution(std::move(angle)).write(row, "facetAngle");
  }
  for (int k = 0; k < 5; ++k)
  {
    const Distribution d(std::move(byAngle[k]));
    const std::string prefix = "incidence" + std::to_string(k);
    row[prefix + "SignedMedian"] = d.signedMedian;
    row[prefix + "P95"] = d.p95;
  }
}

void measureSilhouette(const Picture& picture, const std::vector<TruePixel>& truth,
  const Reference& reference, const svo::View& view, Row& row)
{
  std::size_t both = 0, falseHits = 0, falseMisses = 0, undecided = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    const bool shown = picture.hit(i);
    if (shown == bool(truth[i].hit))
    {
      both += shown;
      continue;
    }
    const double x = static_cast<double>(i % view.width) + 0.5;
    const double y = static_cast<double>(i / view.width) + 0.5;
    // Embree's answers are doubted near a silhouette only: testing all triangles takes long.
    int hits =
      hitsAround(0.01, x, y, [&](double u, double v) { return bool(reference.first(view, u, v)); });
    if (hits != (truth[i].hit ? 4 : 0))
    {
      hits = hitsAround(
        1e-3, x, y, [&](double u, double v) { return bool(reference.settle(view, u, v)); });
    }
    if (hits != 0 && hits != 4)
    {
      ++undecided;
      both += shown;
    }
    else if (shown == (hits == 4))
    {
      both += shown; // Embree was wrong
    }
    else
    {
      ++(shown ? falseHits : falseMisses);
    }
  }
  row["covered"] = static_cast<Json::UInt64>(both + falseMisses);
  row["falseHits"] = static_cast<Json::UInt64>(falseHits);
  row["falseMisses"] = static_cast<Json::UInt64>(falseMisses);
  row["undecided"] = static_cast<Json::UInt64>(undecided);
  row["silhouetteIoU"] =
    static_cast<double>(both) / std::max<std::size_t>(both + falseHits + falseMisses, 1);
}

std::vector<Light> lightOf(const std::vector<TruePixel>& truth)
{
  std::vector<Light> light;
  for (const TruePixel& p : truth)
  {
    light.push_back(!p.hit || p.lit <= LitEnough ? Light::Unlit
        : p.dark                                 ? Light::Dark
                                                 : Light::Lit);
  }
  return light;
}

std::vector<Light> lightOf(const Picture& shadowed, const Picture& unshadowed)
{
  std::vector<Light> light;
  for (std::size_t i = 0; i < shadowed.grey.size(); ++i)
  {
    const int with = shadowed.grey[i], without = unshadowed.grey[i];
    light.push_back(!unshadowed.hit(i) || without < VisibleGrey ? Light::Unlit
        : 2 * with < without                                    ? Light::Dark
                                                                : Light::Lit);
  }
  return light;
}

void measureShadow(const std::vector<Light>& shown, const std::vector<Light>& truth,
  const std::vector<TruePixel>& exact, const Picture& picture, int width, const std::string& prefix,
  Row& row)
{
  const int height = static_cast<int>(truth.size()) / width;
  std::size_t counted = 0, falseDark = 0, falseLit = 0, bothDark = 0, tolerant = 0;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      const TruePixel& p = exact[i];
      if (!sameObject(picture, i, p) || p.atEdge || p.facing <= Grazing ||
        shown[i] == Light::Unlit || truth[i] == Light::Unlit || p.lit <= LitEnough)
      {
        continue;
      }
      ++counted;
      bothDark += shown[i] == Light::Dark && truth[i] == Light::Dark;
      if (shown[i] == truth[i])
      {
        continue;
      }
      ++(shown[i] == Light::Dark ? falseDark : falseLit);
      bool near = false;
      for (int k = std::max(y - 1, 0); k <= std::min(y + 1, height - 1); ++k)
      {
        for (int j = std::max(x - 1, 0); j <= std::min(x + 1, width - 1); ++j)
        {
          near = near || truth[static_cast<std::size_t>(k) * width + j] == shown[i];
        }
      }
      tolerant += !near;
    }
  }
  const double all = static_cast<double>(std::max<std::size_t>(counted, 1));
  row[prefix + "Counted"] = static_cast<Json::UInt64>(counted);
  row[prefix + "Wrong"] = static_cast<double>(falseDark + falseLit) / all;
  row[prefix + "FalseDark"] = static_cast<double>(falseDark) / all;
  row[prefix + "FalseLit"] = static_cast<double>(falseLit) / all;
  row[prefix + "WrongTolerant"] = static_cast<double>(tolerant) / all;
  row[prefix + "IoU"] = static_cast<double>(bothDark) /
    static_cast<double>(std::max<std::size_t>(bothDark + falseDark + falseLit, 1));
}
}
