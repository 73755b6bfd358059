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
#include "svoInstructionSet.h"
#include "svoOcclusionPeers.h"
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
using namespace svobench;

constexpr int Deepest = 11; // of octrees whose level nobody gives

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
