// Rays a second of vtkSVOShadowFilter beside those of vtkStaticCellLocator and of Embree (where it
// was found): the same rays, from the middles of cells that face a light to that light, on one
// thread.
//
//   BenchmarkShadows [--lights 24] [--repeat 5] [--json file] [--ball triangles] [mesh ...]
//
// Medians of processor time, the three taking turns; octrees, locators and Embree's scenes are
// built before, and timed apart. The answers are compared in the run: the exit code is 1 where more
// than one ray in ten thousand disagrees with the locator, or one in a thousand with Embree's
// floats. Then what 1 to 16 samples a cell take under the suns, and how far their shares are from
// those of 64: exit code 1 where more samples are farther off.
#include "svoBenchmarkMesh.h"
#include "svoEmbreeScene.h"
#include "svoResults.h"
#include "vtkSVOShadowFilter.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkGenericCell.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkStaticCellLocator.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

namespace
{
using svobench::Mesh;

double cpuSeconds()
{
  std::timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> v)
{
  std::nth_element(v.begin(), v.begin() + v.size() / 2, v.end());
  return v[v.size() / 2];
}

struct ShadowRay
{
  glm::dvec3 from, to;
  vtkIdType cell;
  int light;
};

/// Suns over half of the sky, or lamps on a sphere of twice the mesh's size.
std::vector<vtkSmartPointer<vtkLight>> lightsAround(
  const glm::dvec3& centre, double size, int count, bool lamps)
{
  std::vector<vtkSmartPointer<vtkLight>> lights;
  for (int i = 0; i < count; ++i)
  {
    const double z = 1.0 - (i + 0.5) / count, turn = 2.39996323 * i, flat = std::sqrt(1.0 - z * z);
    const glm::dvec3 to(flat * std::cos(turn), flat * std::sin(turn), z);
    const glm::dvec3 at = centre + size * to;
    auto light = vtkSmartPointer<vtkLight>::New();
    light->SetLightTypeToSceneLight();
    light->SetPosition(at.x, at.y, at.z);
    light->SetFocalPoint(centre.x, centre.y, centre.z);
    light->SetPositional(lamps);
    light->SetConeAngle(180.0);
    lights.push_back(light);
  }
  return lights;
}

std::vector<ShadowRay> raysOf(const Mesh& mesh, const glm::dvec3& centre, double size,
  const std::vector<vtkSmartPointer<vtkLight>>& lights)
{
  std::vector<ShadowRay> rays;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    const glm::uvec3 t = mesh.triangles[i];
    const glm::dvec3 &a = mesh.points[t.x], &b = mesh.points[t.y], &c = mesh.points[t.z];
    const glm::dvec3 cross = glm::cross(b - a, c - a), middle = (a + b + c) / 3.0;
    if (!(glm::length(cross) > 0.0))
    {
      continue;
    }
    const glm::dvec3 from = middle + 2e-7 * size * glm::normalize(cross);
    for (std::size_t l = 0; l < lights.size(); ++l)
    {
      glm::dvec3 at;
      lights[l]->GetPosition(&at.x);
      const bool lamp = lights[l]->GetPositional();
      const glm::dvec3 way = lamp ? at - middle : at - centre;
      if (glm::dot(way, cross) > 0.0)
      {
        rays.push_back(
          { from, lamp ? at : from + way, static_cast<vtkIdType>(i), static_cast<int>(l) });
      }
    }
  }
  return rays;
}

std::vector<char> throughLocator(vtkStaticCellLocator* locator, const std::vector<ShadowRay>& rays)
{
  std::vector<char> dark(rays.size());
  vtkNew<vtkGenericCell> cell;
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    double t, x[3], pcoords[3];
    int sub;
    vtkIdType hit;
    dark[i] = locator->IntersectWithLine(
                &rays[i].from.x, &rays[i].to.x, 0.0, t, x, pcoords, sub, hit, cell) != 0;
  }
  return dark;
}

#ifdef SVO_EMBREE
std::vector<char> throughEmbree(RTCScene scene, const std::vector<ShadowRay>& rays)
{
  std::vector<char> dark(rays.size());
  svobench::EmbreeQuery query(false);
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    const glm::vec3 from(rays[i].from), way(rays[i].to - rays[i].from);
    RTCRay ray{};
    ray.org_x = from.x;
    ray.org_y = from.y;
    ray.org_z = from.z;
    ray.dir_x = way.x;
    ray.dir_y = way.y;
    ray.dir_z = way.z;
    ray.tnear = 1e-5f;
    ray.tfar = 1.0f;
    ray.mask = ~0u;
    query.occlude(scene, ray);
    dark[i] = ray.tfar < 0.0f;
  }
  return dark;
}
#endif

std::size_t differing(const std::vector<char>& a, const std::vector<char>& b)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    count += a[i] != b[i];
  }
  return count;
}

bool measure(const Mesh& mesh, int lightCount, bool lamps, int repeat, svobench::Results& results)
{
  glm::dvec3 low = mesh.points.front(), high = low;
  for (const glm::dvec3& p : mesh.points)
  {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::dvec3 centre = 0.5 * (low + high);
  const double size = 2.0 * glm::length(high - low);
  const auto lights = lightsAround(centre, size, lightCount, lamps);
  const std::vector<ShadowRay> rays = raysOf(mesh, centre, size, lights);
  const vtkSmartPointer<vtkPolyData> surface = polyData(mesh);

  vtkNew<vtkSVOShadowFilter> filter;
  filter->SetInputData(surface);
  filter->SetSamplesPerCell(1);
  for (const auto& light : lights)
  {
    filter->AddLight(light);
  }
  double begin = cpuSeconds();
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(surface);
  locator->BuildLocator();
  const double locatorBuild = cpuSeconds() - begin;
#ifdef SVO_EMBREE
  begin = cpuSeconds();
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = svobench::makeEmbreeScene(device, mesh, RTC_SCENE_FLAG_ROBUST);
  const double embreeBuild = cpuSeconds() - begin;
#endif

  std::vector<double> ours, single, theirs, embrees;
  std::vector<char> dark(rays.size()), darkAlone(rays.size()), byLocator, byEmbree;
  // The filter's octree is kept from here on.
  filter->Update();
  const double build = filter->GetBuildTime();
  for (int k = 0; k < repeat; ++k)
  {
    for (const bool alone : { false, true })
    {
      filter->SetSingleRays(alone);
      filter->Modified();
      begin = cpuSeconds();
      filter->Update();
      (alone ? single : ours).push_back(cpuSeconds() - begin);
      vtkDataArray* shadow = filter->GetOutput()->GetCellData()->GetArray("Shadow");
      for (std::size_t i = 0; i < rays.size(); ++i)
      {
        (alone ? darkAlone : dark)[i] = shadow->GetComponent(rays[i].cell, rays[i].light) != 0.0;
      }
    }
    begin = cpuSeconds();
    byLocator = throughLocator(locator, rays);
    theirs.push_back(cpuSeconds() - begin);
#ifdef SVO_EMBREE
    begin = cpuSeconds();
    byEmbree = throughEmbree(scene, rays);
    embrees.push_back(cpuSeconds() - begin);
#endif
  }
  const auto count = static_cast<double>(rays.size());
  const std::size_t wrong = differing(dark, byLocator),
                    wrongAlone = differing(darkAlone, byLocator);
  svobench::Row row;
  row["experiment"] = "shadows";
  row["mesh"] = mesh.name;
  row["triangles"] = static_cast<Json::UInt64>(mesh.triangles.size());
  row["lights"] = lamps ? "positional" : "directional";
  row["rays"] = static_cast<Json::UInt64>(rays.size());
  row["dark"] = static_cast<double>(std::count(dark.begin(), dark.end(), 1)) / count;
  row["filter Mrays/s"] = 1e-6 * count / median(ours);
  row["single rays Mrays/s"] = 1e-6 * count / median(single);
  row["locator Mrays/s"] = 1e-6 * count / median(theirs);
  row["times the locator"] = median(theirs) / median(ours);
  row["differ from locator"] = static_cast<Json::UInt64>(wrong);
  row["single differ"] = static_cast<Json::UInt64>(wrongAlone);
  row["octree s"] = build;
  row["locator s"] = locatorBuild;
  bool good =
    static_cast<double>(wrong) <= 1e-4 * count && static_cast<double>(wrongAlone) <= 1e-4 * count;
#ifdef SVO_EMBREE
  const std::size_t wrongEmbree = differing(dark, byEmbree);
  row["Embree Mrays/s"] = 1e-6 * count / median(embrees);
  row["times Embree"] = median(embrees) / median(ours);
  row["differ from Embree"] = static_cast<Json::UInt64>(wrongEmbree);
  row["Embree s"] = embreeBuild;
  good = good && static_cast<double>(wrongEmbree) <= 1e-3 * count;
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
#endif
  results.add(row);
  return good;
}

/// The medians of samples that take turns.
bool measureSamples(const Mesh& mesh, int lightCount, int repeat, svobench::Results& results)
{
  const vtkSmartPointer<vtkPolyData> surface = polyData(mesh);
  vtkNew<vtkSVOShadowFilter> filter;
  filter->SetInputData(surface);
  for (const auto& light : lightsAround(glm::dvec3(0.0), 10.0, lightCount, false))
  {
    filter->AddLight(light);
  }
  const auto shares = [&filter](int samples)
  {
    filter->SetSamplesPerCell(samples);
    filter->Update();
    vtkDataArray* shadow = filter->GetOutput()->GetCellData()->GetArray("Shadow");
    std::vector<double> values;
    for (vtkIdType cell = 0; cell < shadow->GetNumberOfTuples(); ++cell)
    {
      for (int light = 0; light < shadow->GetNumberOfComponents(); ++light)
      {
        values.push_back(shadow->GetComponent(cell, light));
      }
    }
    return values;
  };
  const std::vector<double> fine = shares(64); // the filter's octree is kept from here on
  const std::vector<int> counts = { 1, 2, 4, 8, 16 };
  std::vector<std::vector<double>> seconds(counts.size());
  std::vector<double> off(counts.size());
  for (int turn = 0; turn < repeat; ++turn)
  {
    for (std::size_t i = 0; i < counts.size(); ++i)
    {
      const double begin = cpuSeconds();
      const std::vector<double> values = shares(counts[i]);
      seconds[i].push_back(cpuSeconds() - begin);
      double sum = 0.0;
      for (std::size_t k = 0; k < values.size(); ++k)
      {
        const double d = std::isnan(fine[k]) ? 0.0 : values[k] - fine[k]; // no area, no share
        sum += d * d;
      }
      off[i] = std::sqrt(sum / static_cast<double>(values.size()));
    }
  }
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    svobench::Row row;
    row["experiment"] = "samples";
    row["mesh"] = mesh.name;
    row["samples"] = counts[i];
    row["s"] = median(seconds[i]);
    row["RMS to 64"] = off[i];
    results.add(row);
  }
  return std::is_sorted(off.rbegin(), off.rend());
}
}

int main(int argc, char** argv)
{
  int lights = 24, repeat = 5;
  std::string json, error;
  std::vector<Mesh> meshes;
  for (int i = 1; i < argc; ++i)
  {
    const bool more = i + 1 < argc;
    if (!std::strcmp(argv[i], "--lights") && more)
    {
      lights = std::atoi(argv[++i]);
    }
    else if (!std::strcmp(argv[i], "--repeat") && more)
    {
      repeat = std::atoi(argv[++i]);
    }
    else if (!std::strcmp(argv[i], "--json") && more)
    {
      json = argv[++i];
    }
    else if (!svobench::readArgument(argc, argv, i, meshes, error))
    {
      std::fprintf(stderr, "%s\n", error.c_str());
      return 2;
    }
  }
  if (lights < 1 || repeat < 1)
  {
    std::fprintf(stderr, "BenchmarkShadows: there is nothing to measure\n");
    return 2;
  }
  if (meshes.empty())
  {
    meshes.push_back(svobench::torus(100, 250));
    meshes.push_back(svobench::bumpySphere(160));
  }
  vtkSMPTools::Initialize(1);
  svobench::Results results({ "mesh", "triangles", "lights", "rays", "dark", "filter Mrays/s",
    "single rays Mrays/s", "locator Mrays/s", "times the locator", "Embree Mrays/s", "times Embree",
    "differ from locator", "single differ", "differ from Embree", "octree s", "locator s",
    "Embree s", "samples", "s", "RMS to 64" });
  bool good = true;
  for (const Mesh& mesh : meshes)
  {
    for (const bool lamps : { false, true })
    {
      good = measure(mesh, lights, lamps, repeat, results) && good;
    }
    good = measureSamples(mesh, lights, repeat, results) && good;
  }
  if (!json.empty() && !results.writeJson(json))
  {
    return 2;
  }
  return good ? 0 : 1;
}
