// Other ways to ask whether rays meet anything: alone in double, the nearest hits, Embree's.
#ifndef svoOcclusionPeers_h
#define svoOcclusionPeers_h

#include "svoBenchmarkMesh.h"
#include "svoEmbreeScene.h"
#include "svoOcclusionRays.h"

#include <ctime>

namespace svobench
{
/// Processor time.
inline double threadSeconds()
{
  std::timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

inline void occludedAlone(const svo::Octree& octree, const svo::TraceOptions& options,
  const Batches& batches, Answers& answers)
{
  std::fill(answers.begin(), answers.end(), 0);
  batches.forEach(
    [&](const OcclusionRays& rays, int i, std::size_t word, std::uint64_t bit)
    {
      svo::Ray ray;
      ray.origin = { rays.originX[i], rays.originY[i], rays.originZ[i] };
      ray.direction = { rays.directionX[i], rays.directionY[i], rays.directionZ[i] };
      ray.tMax = rays.tMax[i];
      answers[word] |= svo::occluded(octree, ray, options) ? bit : 0;
    });
}

/// By the query that finds the nearest hits.
inline void nearest(const svo::Octree& octree, const svo::TraceOptions& options,
  const Batches& batches, Answers& answers)
{
  for (std::size_t b = 0; b < batches.rays.size(); ++b)
  {
    const OcclusionRays& rays = batches.rays[b];
    for (int first = 0; first < rays.count; first += svo::RayBlock::Size)
    {
      svo::RayBlock block;
      for (int i = 0; i < svo::RayBlock::Size; ++i)
      {
        const int k = std::min(first + i, rays.count - 1);
        block.aim(i, glm::vec3(rays.originX[k], rays.originY[k], rays.originZ[k]),
          glm::vec3(rays.directionX[k], rays.directionY[k], rays.directionZ[k]));
        block.tMin[i] = 0.0f;
        block.tMax[i] = first + i < rays.count ? rays.tMax[k] : -1.0f;
      }
      svo::HitBlock hits;
      svo::intersect(octree, block, options, hits);
      std::uint64_t bits = 0;
      for (int i = 0; i < svo::RayBlock::Size; ++i)
      {
        bits |= std::uint64_t(hits.primitive[i] != svo::NoPrimitive) << i;
      }
      answers[b * Words + first / svo::RayBlock::Size] = bits;
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
inline Mesh meshOf(const svo::Octree& octree)
{
  const svo::Surface& surface = *octree.surface();
  return { "", { surface.points.begin(), surface.points.end() }, surface.triangles };
}
#endif
}

#endif
