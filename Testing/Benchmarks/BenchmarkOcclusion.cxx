// How fast rays are of which only is asked whether they meet anything, and that go anywhere: those
// of ambient occlusion, from what the pixels of pictures see, 8 directions each, without end and up
// to a fifth of the mesh's size. Beside Embree, where it was found, on one thread.
//
//   BenchmarkOcclusion [--level n] [--rays n] [--repeat n] [--isa AVX-512|AVX2|SSE4|scalar]
//                      [--json file] [--ball triangles] [mesh ...]
//
// Medians of the thread's processor time; who is measured takes turns. Octrees have the level that
// the pass builds, up to 11, or the given one. Embree's rays are filled in before its time begins.
// The answers are compared in the run: the exit code is 1 where more than one ray in a thousand
// disagrees with Embree's robust mode or with our own single rays in double.
#include "svoBenchmarkMesh.h"
#include "svoEmbreeScene.h"
#include "svoInstructionSet.h"
#include "svoResults.h"

#include "svoBuild.h"
#include "svoIntersect.h"
#include "svoOcclusion.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

namespace
{
using namespace svo;

constexpr int Directions = 8; // of a pixel
constexpr int Deepest = 11;   // of octrees whose level nobody gives
constexpr std::size_t Words = OcclusionRays::Most / 64;

struct Settings
{
  int level = 0; // 0: the pass's
  int rays = 1 << 18;
  int repeat = 9;
  std::string isa, json;
  std::vector<svobench::Mesh> meshes;
};

bool readSettings(int argc, char** argv, Settings& settings, std::string& error)
{
  for (int i = 1; i < argc; ++i)
  {
    const std::string a = argv[i];
    const bool more = i + 1 < argc;
    if (a == "--isa" && more)
    {
      settings.isa = argv[++i];
    }
    else if (a == "--json" && more)
    {
      settings.json = argv[++i];
    }
    else if (a == "--level" && more)
    {
      settings.level = std::clamp(std::atoi(argv[++i]), 0, MaximumLevel);
    }
    else if (a == "--rays" && more)
    {
      settings.rays = std::max(std::atoi(argv[++i]), OcclusionRays::Most);
    }
    else if (a == "--repeat" && more)
    {
      settings.repeat = std::max(std::atoi(argv[++i]), 1);
    }
    else if (!svobench::readArgument(argc, argv, i, settings.meshes, error))
    {
      return false;
    }
  }
  return true;
}

double threadSeconds()
{
  std::timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Rays in batches, and what becomes of them.
struct Batches
{
  std::vector<OcclusionRays> rays;
  std::size_t count = 0;

  template <class Visit>
  void forEach(Visit&& visit) const
  {
    for (std::size_t b = 0; b < this->rays.size(); ++b)
    {
      for (int i = 0; i < this->rays[b].count; ++i)
      {
        visit(this->rays[b], i, b * Words + i / 64, std::uint64_t(1) << i % 64);
      }
    }
  }
};
using Answers = std::vector<std::uint64_t>;

/// Eyes look at random places of the surface, 8x8 pixels each; from what they see rays go into the
/// half space of the facet's normal, more of them along it.
class Pixels
{
public:
  Pixels(const Octree& o, int rays)
    : octree(o)
  {
    const Surface& surface = *o.surface();
    double area = 0.0;
    for (std::uint32_t i = 0; i < surface.triangles.size(); ++i)
    {
      this->areas.push_back(area += 0.5 * glm::length(this->normal(i)));
    }
    while (this->batches.count < static_cast<std::size_t>(rays))
    {
      this->look();
    }
  }

  /// The same rays up to an end.
  Batches upTo(float tMax) const
  {
    Batches result = this->batches;
    for (OcclusionRays& rays : result.rays)
    {
      std::fill_n(rays.tMax, rays.count, tMax);
    }
    return result;
  }

private:
  glm::dvec3 corner(std::uint32_t triangle, int k) const
  {
    const Surface& surface = *this->octree.surface();
    return surface.points[surface.triangles[triangle][k]];
  }
  glm::dvec3 normal(std::uint32_t triangle) const
  {
    const glm::dvec3 a = this->corner(triangle, 0);
    return glm::cross(this->corner(triangle, 1) - a, this->corner(triangle, 2) - a);
  }
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(this->random); }
  /// In the half space of a unit vector, of a density as the cosine to it.
  glm::dvec3 around(const glm::dvec3& n)
  {
    const double z = 2.0 * this->unit() - 1.0, turn = 6.283185307179586 * this->unit();
    const double flat = std::sqrt(std::max(1.0 - z * z, 0.0));
    const glm::dvec3 d = n + glm::dvec3(flat * std::cos(turn), flat * std::sin(turn), z);
    return glm::length(d) > 1e-6 ? glm::normalize(d) : n;
  }

  void look()
  {
    const double edge = 1.0 / (1 << this->octree.rootBits(0));
    const auto at =
      std::upper_bound(this->areas.begin(), this->areas.end(), this->unit() * this->areas.back());
    const auto triangle = static_cast<std::uint32_t>(
      std::min<std::ptrdiff_t>(at - this->areas.begin(), this->areas.size() - 1));
    const glm::dvec3 n = this->normal(triangle);
    if (!(glm::length(n) > 0.0))
    {
      return;
    }
    const double u = std::sqrt(this->unit()), v = this->unit();
    const glm::dvec3 seen = (1.0 - u) * this->corner(triangle, 0) +
      u * (1.0 - v) * this->corner(triangle, 1) + u * v * this->corner(triangle, 2);
    const glm::dvec3 back = this->around(glm::normalize(n));
    const glm::dvec3 right = glm::normalize(
      glm::cross(back, std::abs(back.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(back, right);
    const glm::dvec3 eye = seen + 0.5 * edge * back;
    RayBlock block;
    for (int i = 0; i < RayBlock::Size; ++i)
    {
      const double pixel = 1e-3 * edge;
      block.aim(i, eye, -0.5 * edge * back + pixel * ((i % 8 - 3.5) * right + (i / 8 - 3.5) * up));
      block.tMin[i] = 0.0f;
      block.tMax[i] = 4.0f;
    }
    HitBlock hits;
    TraceOptions options;
    options.leafGeometry = LeafGeometry::Triangle;
    intersect(this->octree, block, options, hits);
    OcclusionRays& rays = this->batches.rays.emplace_back();
    for (int i = 0; i < RayBlock::Size; ++i)
    {
      if (hits.primitive[i] == NoPrimitive)
      {
        continue;
      }
      const glm::dvec3 direction(block.directionX[i], block.directionY[i], block.directionZ[i]);
      glm::dvec3 facing = glm::normalize(this->normal(hits.primitive[i]));
      facing = glm::dot(facing, direction) > 0.0 ? -facing : facing;
      const glm::dvec3 origin =
        eye + static_cast<double>(hits.t[i]) * direction + 1e-6 * edge * facing;
      for (int k = 0; k < Directions; ++k)
      {
        const int j = rays.count++;
        const glm::dvec3 way = this->around(facing);
        rays.originX[j] = static_cast<float>(origin.x);
        rays.originY[j] = static_cast<float>(origin.y);
        rays.originZ[j] = static_cast<float>(origin.z);
        rays.directionX[j] = static_cast<float>(way.x);
        rays.directionY[j] = static_cast<float>(way.y);
        rays.directionZ[j] = static_cast<float>(way.z);
      }
    }
    this->batches.count += static_cast<std::size_t>(rays.count);
  }

  const Octree& octree;
  std::mt19937 random{ 1 };
  std::vector<double> areas; // of the triangles up to each
  Batches batches;
};

void occludedAlone(
  const Octree& octree, const TraceOptions& options, const Batches& batches, Answers& answers)
{
  std::fill(answers.begin(), answers.end(), 0);
  batches.forEach(
    [&](const OcclusionRays& rays, int i, std::size_t word, std::uint64_t bit)
    {
      Ray ray;
      ray.origin = { rays.originX[i], rays.originY[i], rays.originZ[i] };
      ray.direction = { rays.directionX[i], rays.directionY[i], rays.directionZ[i] };
      ray.tMax = rays.tMax[i];
      answers[word] |= occluded(octree, ray, options) ? bit : 0;
    });
}

/// By the query that finds the nearest hits.
void nearest(
  const Octree& octree, const TraceOptions& options, const Batches& batches, Answers& answers)
{
  for (std::size_t b = 0; b < batches.rays.size(); ++b)
  {
    const OcclusionRays& rays = batches.rays[b];
    for (int first = 0; first < rays.count; first += RayBlock::Size)
    {
      RayBlock block;
      for (int i = 0; i < RayBlock::Size; ++i)
      {
        const int k = std::min(first + i, rays.count - 1);
        block.aim(i, glm::vec3(rays.originX[k], rays.originY[k], rays.originZ[k]),
          glm::vec3(rays.directionX[k], rays.directionY[k], rays.directionZ[k]));
        block.tMin[i] = 0.0f;
        block.tMax[i] = first + i < rays.count ? rays.tMax[k] : -1.0f;
      }
      HitBlock hits;
      intersect(octree, block, options, hits);
      std::uint64_t bits = 0;
      for (int i = 0; i < RayBlock::Size; ++i)
      {
        bits |= std::uint64_t(hits.primitive[i] != NoPrimitive) << i;
      }
      answers[b * Words + first / RayBlock::Size] = bits;
    }
  }
}

#ifdef SVO_EMBREE
/// The same rays, N side by side, of one scene.
template <class Packet, int N>
class EmbreeRays
{
public:
  EmbreeRays(RTCScene s, const Batches& batches)
    : scene(s)
  {
    std::size_t n = 0;
    this->rays.resize((batches.count + N - 1) / N);
    this->words.resize(this->rays.size() * N);
    this->bits.resize(this->rays.size() * N);
    batches.forEach(
      [&](const OcclusionRays& from, int i, std::size_t word, std::uint64_t bit)
      {
        Packet& to = this->rays[n / N];
        const auto set = [&](auto& member, auto value)
        {
          if constexpr (N == 1)
          {
            member = value;
          }
          else
          {
            member[n % N] = value;
          }
        };
        set(to.org_x, from.originX[i]);
        set(to.org_y, from.originY[i]);
        set(to.org_z, from.originZ[i]);
        set(to.dir_x, from.directionX[i]);
        set(to.dir_y, from.directionY[i]);
        set(to.dir_z, from.directionZ[i]);
        set(to.tnear, 0.0f);
        set(to.tfar, from.tMax[i]);
        set(to.mask, ~0u);
        this->words[n] = word;
        this->bits[n] = bit;
        ++n;
      });
    this->count = n;
  }

  /// Returns the time it took.
  double trace(Answers& answers)
  {
    this->traced = this->rays;
    svobench::EmbreeQuery query(false);
    const double begin = threadSeconds();
    for (std::size_t p = 0; p < this->traced.size(); ++p)
    {
      if constexpr (N == 1)
      {
        query.occlude(this->scene, this->traced[p]);
      }
      else
      {
        alignas(64) int valid[N];
        for (int i = 0; i < N; ++i)
        {
          valid[i] = p * N + i < this->count ? -1 : 0;
        }
        query.occlude(this->scene, valid, this->traced[p]);
      }
    }
    const double seconds = threadSeconds() - begin;
    std::fill(answers.begin(), answers.end(), 0);
    for (std::size_t n = 0; n < this->count; ++n)
    {
      float end;
      if constexpr (N == 1)
      {
        end = this->traced[n].tfar;
      }
      else
      {
        end = this->traced[n / N].tfar[n % N];
      }
      answers[this->words[n]] |= end < 0.0f ? this->bits[n] : 0;
    }
    return seconds;
  }

private:
  RTCScene scene;
  std::size_t count = 0;
  std::vector<Packet> rays, traced;
  std::vector<std::size_t> words;
  std::vector<std::uint64_t> bits;
};

/// Of an octree's own triangles, so that both have the same bits.
svobench::Mesh meshOf(const Octree& octree)
{
  const Surface& surface = *octree.surface();
  return { "", { surface.points.begin(), surface.points.end() }, surface.triangles };
}
#endif

std::size_t differing(const Answers& a, const Answers& b)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    count += countBits(a[i] ^ b[i]);
  }
  return count;
}

double median(std::vector<double> v)
{
  std::nth_element(v.begin(), v.begin() + v.size() / 2, v.end());
  return v[v.size() / 2];
}

/// All who answer the same rays, by name.
class Contest
{
public:
  Contest(const Batches& b, int r)
    : batches(b)
    , repeat(r)
  {
  }
  /// run: answers all rays and returns the seconds that it took.
  void add(const std::string& name, std::function<double(Answers&)> run)
  {
    this->runners.push_back(
      { name, std::move(run), Answers(this->batches.rays.size() * Words), {} });
  }
  void add(const std::string& name, const std::function<void(Answers&)>& run)
  {
    this->add(name,
      std::function<double(Answers&)>(
        [run](Answers& answers)
        {
          const double begin = threadSeconds();
          run(answers);
          return threadSeconds() - begin;
        }));
  }
  void run()
  {
    for (int k = 0; k <= this->repeat; ++k) // the first is to warm up
    {
      for (Runner& runner : this->runners)
      {
        const double seconds = runner.run(runner.answers);
        if (k > 0)
        {
          runner.seconds.push_back(seconds);
        }
      }
    }
  }
  /// Of 1e6 rays a second.
  double rate(const std::string& name) const
  {
    return 1e-6 * static_cast<double>(this->batches.count) / median(this->find(name).seconds);
  }
  const Answers& answers(const std::string& name) const { return this->find(name).answers; }

private:
  struct Runner
  {
    std::string name;
    std::function<double(Answers&)> run;
    Answers answers;
    std::vector<double> seconds;
  };
  const Runner& find(const std::string& name) const
  {
    return *std::find_if(this->runners.begin(), this->runners.end(),
      [&](const Runner& runner) { return runner.name == name; });
  }

  const Batches& batches;
  int repeat;
  std::vector<Runner> runners;
};

bool measure(const svobench::Mesh& mesh, const Octree& octree, const Batches& batches,
  const std::string& reach, const Settings& settings, svobench::Results& results)
{
  TraceOptions options;
  Contest contest(batches, settings.repeat);
  contest.add("ours",
    [&](Answers& answers)
    {
      for (std::size_t b = 0; b < batches.rays.size(); ++b)
      {
        occluded(octree, batches.rays[b], options, &answers[b * Words]);
      }
    });
  contest.add(
    "single", [&](Answers& answers) { occludedAlone(octree, options, batches, answers); });
  contest.add("nearest", [&](Answers& answers) { nearest(octree, options, batches, answers); });
#ifdef SVO_EMBREE
  const bool peer = settings.isa != "scalar";
  RTCDevice device = rtcNewDevice(("threads=1" + svobench::embreeIsa(settings.isa)).c_str());
  RTCScene fast = svobench::makeEmbreeScene(device, meshOf(octree), RTC_SCENE_FLAG_NONE);
  RTCScene robust = svobench::makeEmbreeScene(device, meshOf(octree), RTC_SCENE_FLAG_ROBUST);
  EmbreeRays<RTCRay, 1> one(fast, batches), exact(robust, batches);
  EmbreeRays<RTCRay8, 8> eight(fast, batches);
  EmbreeRays<RTCRay16, 16> sixteen(fast, batches);
  if (peer)
  {
    contest.add(
      "Embree 1", std::function<double(Answers&)>([&](Answers& a) { return one.trace(a); }));
    contest.add(
      "Embree 8", std::function<double(Answers&)>([&](Answers& a) { return eight.trace(a); }));
    contest.add(
      "Embree 16", std::function<double(Answers&)>([&](Answers& a) { return sixteen.trace(a); }));
    contest.add(
      "Embree robust", std::function<double(Answers&)>([&](Answers& a) { return exact.trace(a); }));
  }
#endif
  contest.run();

  const auto rays = static_cast<double>(batches.count);
  const Answers& ours = contest.answers("ours");
  const std::size_t wrong = differing(ours, contest.answers("single"));
  bool good = static_cast<double>(wrong) <= 1e-3 * rays;
  svobench::Row row;
  row["experiment"] = "occlusion";
  row["mesh"] = mesh.name;
  row["triangles"] = static_cast<Json::UInt64>(mesh.triangles.size());
  row["level"] = octree.level();
  row["instructionSet"] = settings.isa.empty() ? instructionSet() : settings.isa;
  row["reach"] = reach;
  row["rays"] = static_cast<Json::UInt64>(batches.count);
  row["dark"] = static_cast<double>(differing(ours, Answers(ours.size()))) / rays;
  row["ours Mrays/s"] = contest.rate("ours");
  row["single Mrays/s"] = contest.rate("single");
  row["nearest Mrays/s"] = contest.rate("nearest");
  row["differ from single"] = static_cast<double>(wrong) / rays;
  row["differ from nearest"] =
    static_cast<double>(differing(ours, contest.answers("nearest"))) / rays;
#ifdef SVO_EMBREE
  if (peer)
  {
    double best = 0.0;
    for (const char* name : { "Embree 1", "Embree 8", "Embree 16", "Embree robust" })
    {
      row[std::string(name) + " Mrays/s"] = contest.rate(name);
      best = std::max(best, contest.rate(name));
    }
    const std::size_t other = differing(ours, contest.answers("Embree robust"));
    row["Embree's best Mrays/s"] = best;
    row["times Embree's best"] = contest.rate("ours") / best;
    row["differ from Embree"] = static_cast<double>(other) / rays;
    good = good && static_cast<double>(other) <= 1e-3 * rays;
  }
  rtcReleaseScene(fast);
  rtcReleaseScene(robust);
  rtcReleaseDevice(device);
#endif
  results.add(row);
  return good;
}
}

int main(int argc, char** argv)
{
  Settings settings;
  std::string error;
  if (!readSettings(argc, argv, settings, error))
  {
    std::fprintf(stderr, "BenchmarkOcclusion: %s\n", error.c_str());
    return 2;
  }
  if (!svobench::useInstructionSet(settings.isa))
  {
    std::fprintf(stderr, "BenchmarkOcclusion: this machine has no %s\n", settings.isa.c_str());
    return 2;
  }
  if (settings.meshes.empty())
  {
    settings.meshes = { svobench::torus(200, 120), svobench::bumpySphere(160),
      svobench::city(5000) };
  }
  svobench::Results results({ "mesh", "level", "instructionSet", "reach", "dark", "ours Mrays/s",
    "single Mrays/s", "nearest Mrays/s", "Embree 1 Mrays/s", "Embree 8 Mrays/s",
    "Embree 16 Mrays/s", "Embree robust Mrays/s", "times Embree's best", "differ from single",
    "differ from nearest", "differ from Embree" });
  bool good = true;
  for (const svobench::Mesh& mesh : settings.meshes)
  {
    BuildOptions options;
    options.level =
      settings.level > 0 ? settings.level : std::min(svobench::detailLevel(mesh), Deepest);
    const BuildResult built = build(mesh.view(), options);
    if (built.status != BuildStatus::Built)
    {
      std::fprintf(stderr, "BenchmarkOcclusion: %s\n", built.message.c_str());
      return 2;
    }
    const Header& header = *reinterpret_cast<const Header*>(built.data.get());
    const Octree octree =
      Octree::open(built.data, built.size, makeSurface(mesh.view(), {}, header, serialFor), error);
    const Pixels pixels(octree, settings.rays);
    const float fifth = 0.2f / static_cast<float>(1 << octree.rootBits(0));
    for (const bool endless : { true, false })
    {
      const Batches batches = pixels.upTo(endless ? std::numeric_limits<float>::max() : fifth);
      good = measure(mesh, octree, batches, endless ? "endless" : "0.2", settings, results) && good;
    }
  }
  return (settings.json.empty() || results.writeJson(settings.json)) ? (good ? 0 : 1) : 2;
}
