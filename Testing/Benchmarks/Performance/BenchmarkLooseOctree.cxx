// What a loose octree over many objects takes: inserting, moving, asking what a frustum sees;
// beside a flat test of all balls against six planes with all lanes of the machine.
//
//   BenchmarkLooseOctree [--objects 100000,1000000] [--repeat 9] [--json file]
//
// Objects lie in a cube, one in a unit of volume on average, their names in no order of space:
// uniform, with radii of 0.1 to 0.3, or mixed, with radii from 1e-3 to 1, as many of one size as of
// another. Eyes stand outside at the eight corners, a quarter of the cube away from it; their angle
// is such that they see 0.1, 1, 10, 50 and 100 % of the balls; once as the tree is after inserting
// and once arranged. The methods take turns; medians of processor time on one thread.
//
// All balls that a test in double does not find outside have to be found by both, or the exit code
// is 1; `extra` is what they find besides, in percent of those.
#include "performanceFlatTest.h"
#include "svoResults.h"
#include "svoSeenObjects.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/vec3.hpp>

namespace
{
struct Options
{
  std::vector<std::uint32_t> objects{ 100000, 1000000 };
  int repeat = 9;
};

/// s
double processorTime()
{
  std::timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double secondsOf(const std::function<void()>& work)
{
  const double start = processorTime();
  work();
  return processorTime() - start;
}

double median(std::vector<double> v)
{
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

struct Scene
{
  double edge;
  std::vector<svo::Ball> balls;
};

Scene makeScene(std::uint32_t objects, bool mixed)
{
  std::mt19937 random(17);
  Scene scene{ std::cbrt(objects), std::vector<svo::Ball>(objects) };
  std::uniform_real_distribution<double> place(0.0, scene.edge), radius(0.1, 0.3),
    digits(-3.0, 0.0);
  for (svo::Ball& ball : scene.balls)
  {
    ball.centre = { place(random), place(random), place(random) };
    ball.radius = mixed ? std::pow(10.0, digits(random)) : radius(random);
  }
  return scene;
}

svo::LooseOctree emptyTree(const Scene& scene)
{
  return svo::LooseOctree(glm::dvec3(0.5 * scene.edge), 1.01 * scene.edge);
}

svo::View viewFrom(const Scene& scene, int corner, double angle)
{
  const glm::dvec3 middle(0.5 * scene.edge);
  const glm::dvec3 to(corner & 1 ? 1.0 : -1.0, corner & 2 ? 0.9 : -0.9, corner & 4 ? 1.1 : -1.1);
  svo::View view;
  svo::makeView(glm::lookAt(middle + 0.75 * scene.edge * to, middle, glm::dvec3(0.1, 0.2, 1.0)),
    glm::perspective(angle, 1.5, 0.01, 4.0 * scene.edge), 1920, 1280, view);
  return view;
}

bool outside(const svo::Frustum& frustum, const svo::Ball& ball)
{
  for (int i = 0; i < frustum.planes(); ++i)
  {
    const glm::dvec4 plane = frustum.plane(i);
    if (glm::dot(glm::dvec3(plane), ball.centre) + plane.w < -ball.radius)
    {
      return true;
    }
  }
  return false;
}

/// What is not outside, one by one.
std::vector<std::uint32_t> seenExactly(const Scene& scene, const svo::Frustum& frustum)
{
  std::vector<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < scene.balls.size(); ++i)
  {
    if (!outside(frustum, scene.balls[i]))
    {
      seen.push_back(i);
    }
  }
  return seen;
}

/// The frustum from a corner that sees a share of the balls.
svo::View viewOf(const Scene& scene, int corner, double share)
{
  double low = 1e-4, high = 2.5;
  for (int i = 0; i < 16; ++i)
  {
    const double middle = 0.5 * (low + high);
    const std::size_t seen =
      seenExactly(scene, svo::Frustum(viewFrom(scene, corner, middle), 0.0)).size();
    (static_cast<double>(seen) < share * static_cast<double>(scene.balls.size()) ? low : high) =
      middle;
  }
  return viewFrom(scene, corner, high);
}

/// What a method found, beside what it has to find.
struct Checked
{
  std::size_t missed = 0, extra = 0;
};

Checked check(std::vector<std::uint32_t> found, const std::vector<std::uint32_t>& expected)
{
  std::sort(found.begin(), found.end());
  std::vector<std::uint32_t> both;
  std::set_intersection(
    found.begin(), found.end(), expected.begin(), expected.end(), std::back_inserter(both));
  return { expected.size() - both.size(), found.size() - both.size() };
}

class Measured
{
public:
  Measured(const Scene& scene, const Options& options)
    : Asked(options)
    , Objects(scene)
    , Flat(scene.balls.size())
    , Tree(emptyTree(scene))
    , Seen(scene.balls.size() + 64)
  {
    for (std::size_t i = 0; i < scene.balls.size(); ++i)
    {
      const svo::Ball& ball = scene.balls[i];
      this->Flat.x[i] = static_cast<float>(ball.centre.x);
      this->Flat.y[i] = static_cast<float>(ball.centre.y);
      this->Flat.z[i] = static_cast<float>(ball.centre.z);
      // Never less than in double: both round coordinates.
      this->Flat.radius[i] = static_cast<float>(ball.radius * (1.0 + 1e-6) + 1e-6 * scene.edge);
    }
  }

  /// ns an object.
  void changes(svobench::Row& row)
  {
    const std::uint32_t count = static_cast<std::uint32_t>(this->Objects.balls.size());
    std::mt19937 random(23);
    std::uniform_real_distribution<double> step(-0.02, 0.02), place(0.0, this->Objects.edge);
    std::vector<glm::dvec3> steps(count), places(count);
    for (std::uint32_t i = 0; i < count; ++i)
    {
      steps[i] = { step(random), step(random), step(random) };
      places[i] = { place(random), place(random), place(random) };
    }
    std::vector<std::uint32_t> shuffled(count);
    std::iota(shuffled.begin(), shuffled.end(), 0u);
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    std::map<std::string, std::vector<double>> times;
    const auto time = [&](const std::string& name, const std::function<void()>& work)
    { times[name].push_back(1e9 * secondsOf(work) / count); };
    const std::vector<svo::Ball>& balls = this->Objects.balls;
    for (int k = 0; k < this->Asked.repeat; ++k)
    {
      this->Tree = emptyTree(this->Objects);
      time("insert",
        [&]
        {
          for (std::uint32_t i = 0; i < count; ++i)
          {
            this->Tree.insert(i, balls[i].centre, balls[i].radius);
          }
        });
      row["bytes"] = static_cast<double>(this->Tree.memory()) / count;
      row["nodes"] = static_cast<double>(this->Tree.nodes()) / count;
      time("small moves",
        [&]
        {
          for (std::uint32_t i = 0; i < count; ++i)
          {
            this->Tree.move(i, balls[i].centre + steps[i], balls[i].radius);
          }
        });
      time("small moves, shuffled",
        [&]
        {
          for (const std::uint32_t i : shuffled)
          {
            this->Tree.move(i, balls[i].centre, balls[i].radius);
          }
        });
      time("long moves",
        [&]
        {
          for (std::uint32_t i = 0; i < count; ++i)
          {
            this->Tree.move(i, places[i], balls[i].radius);
          }
        });
      time("remove and insert",
        [&]
        {
          for (std::uint32_t i = 0; i < count; ++i)
          {
            this->Tree.remove(i);
            this->Tree.insert(i, balls[i].centre, balls[i].radius);
          }
        });
      time("arrange", [&] { this->Tree.arrange(); });
    }
    for (const auto& [name, ns] : times)
    {
      row[name] = median(ns);
    }
  }

  /// The tree as it is after inserting, in no order of space.
  void insertAnew()
  {
    this->Tree = emptyTree(this->Objects);
    for (std::uint32_t i = 0; i < this->Objects.balls.size(); ++i)
    {
      this->Tree.insert(i, this->Objects.balls[i].centre, this->Objects.balls[i].radius);
    }
  }
  void arrange() { this->Tree.arrange(); }

  /// us a query; false if something that is seen was missed.
  bool queries(double share, svobench::Row& row)
  {
    constexpr int Corners = 8;
    std::vector<double> tree, flat;
    std::size_t expected = 0, treeExtra = 0, flatExtra = 0, missed = 0;
    std::vector<svo::View> views;
    for (int c = 0; c < Corners; ++c)
    {
      views.push_back(viewOf(this->Objects, c, share));
    }
    for (int k = -1; k < this->Asked.repeat; ++k)
    {
      double treeTime = 0.0, flatTime = 0.0;
      for (const svo::View& view : views)
      {
        const svo::Frustum frustum(view, 0.0);
        glm::vec4 planes[6];
        for (int p = 0; p < 6; ++p)
        {
          planes[p] = glm::vec4(frustum.plane(p));
        }
        std::size_t found = 0, flatFound = 0;
        const svo::VisitOrder order = svo::VisitOrder::of(view);
        treeTime += secondsOf(
          [&]
          {
            std::uint32_t* seen = this->Seen.data();
            svo::eachSeen(
              this->Tree, frustum, order, [](const svo::LooseNode&) {},
              [&](std::uint32_t object) { *seen++ = object; });
            found = static_cast<std::size_t>(seen - this->Seen.data());
          });
        const auto list = [&](std::size_t length)
        {
          return std::vector<std::uint32_t>(
            this->Seen.begin(), this->Seen.begin() + static_cast<std::ptrdiff_t>(length));
        };
        std::vector<std::uint32_t> exactly;
        if (k < 0)
        {
          exactly = seenExactly(this->Objects, frustum);
          const Checked checked = check(list(found), exactly);
          expected += exactly.size();
          treeExtra += checked.extra;
          missed += checked.missed;
        }
        flatTime += secondsOf(
          [&] { flatFound = performance::flatTest(this->Flat, planes, this->Seen.data()); });
        if (k < 0)
        {
          const Checked checked = check(list(flatFound), exactly);
          flatExtra += checked.extra;
          missed += checked.missed;
        }
      }
      if (k >= 0)
      {
        tree.push_back(1e6 * treeTime / Corners);
        flat.push_back(1e6 * flatTime / Corners);
      }
    }
    row["seen %"] = 100.0 * static_cast<double>(expected) / Corners /
      static_cast<double>(this->Objects.balls.size());
    row["tree us"] = median(tree);
    row["flat us"] = median(flat);
    row["ratio"] = median(flat) / median(tree);
    const double percent = 100.0 / static_cast<double>(std::max<std::size_t>(expected, 1));
    row["tree extra %"] = percent * static_cast<double>(treeExtra);
    row["flat extra %"] = percent * static_cast<double>(flatExtra);
    row["missed"] = static_cast<Json::UInt64>(missed);
    return missed == 0 && expected > 0;
  }

private:
  Options Asked;
  Scene Objects;
  performance::FlatBalls Flat;
  svo::LooseOctree Tree;
  std::vector<std::uint32_t> Seen;
};
}

int main(int argc, char* argv[])
{
  Options options;
  std::string json;
  for (int i = 1; i + 1 < argc; i += 2)
  {
    const std::string name = argv[i];
    if (name == "--objects")
    {
      options.objects.clear();
      std::stringstream list(argv[i + 1]);
      for (std::string one; std::getline(list, one, ',');)
      {
        options.objects.push_back(static_cast<std::uint32_t>(std::max(1, std::atoi(one.c_str()))));
      }
    }
    else if (name == "--repeat")
    {
      options.repeat = std::max(1, std::atoi(argv[i + 1]));
    }
    else if (name == "--json")
    {
      json = argv[i + 1];
    }
    else
    {
      std::fprintf(stderr, "unknown option %s\n", argv[i]);
      return 2;
    }
  }
  svobench::Results results({ "experiment", "sizes", "objects", "insert", "small moves",
    "small moves, shuffled", "long moves", "remove and insert", "arrange", "bytes", "nodes",
    "seen %", "tree us", "flat us", "ratio", "tree extra %", "flat extra %", "missed" });
  bool valid = true;
  for (const bool mixed : { false, true })
  {
    for (const std::uint32_t objects : options.objects)
    {
      Measured measured(makeScene(objects, mixed), options);
      svobench::Row row;
      row["sizes"] = mixed ? "mixed" : "uniform";
      row["objects"] = objects;
      svobench::Row changes = row;
      changes["experiment"] = "changes, ns";
      measured.changes(changes);
      results.add(changes);
      for (const bool arranged : { false, true })
      {
        arranged ? measured.arrange() : measured.insertAnew();
        for (const double share : { 0.001, 0.01, 0.1, 0.5, 1.0 })
        {
          svobench::Row query = row;
          query["experiment"] = arranged ? "query, arranged" : "query";
          valid = measured.queries(share, query) && valid;
          results.add(query);
        }
      }
    }
  }
  if (!valid)
  {
    std::fprintf(stderr, "something that is seen was missed, or nothing is seen\n");
  }
  return (json.empty() || results.writeJson(json)) && valid ? 0 : 1;
}
