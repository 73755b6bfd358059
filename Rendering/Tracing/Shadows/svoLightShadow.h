// The shadow of one light as a frame asks for it, whatever it is found by.
#ifndef svoLightShadow_h
#define svoLightShadow_h

#include "svoBox.h"
#include "svoFrame.h"
#include "svoLightBuffers.h"
#include "svoLightTile.h"
#include "svoParallel.h"
#include "svoSampleSums.h"
#include "svoTerminator.h"
#include "svoTilePatch.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <vector>

namespace svo
{
/// How far points may lie from the surface that they stand for, world: as far as it matters to
/// shadow buffers (worldMapError()), and to rays (worldLeafError()).
struct PointErrors
{
  double map = 0.0, ray = 0.0;
};

/// Points of a patch that are asked about. All that is told of points is told by pixel.
struct ShadowQuery
{
  const TilePatch& patch;
  PointErrors errors;
  const double* extents; // world, how wide a piece of surface they stand for; to those who filter
  std::uint64_t asked;
  std::uint64_t& rays;        // adds those that are cast
  SampleSums* sums = nullptr; // takes what answers are means of, of those who sample; or null: all
                              // samples are taken
  int firstSample() const { return this->sums ? this->sums->first : 0; }
};

/// Sets what points miss: all of the light where they are dark, nothing elsewhere. Returns these.
inline std::uint64_t missAll(std::uint64_t dark, float* missed)
{
  std::fill_n(missed, TilePatch::Most, 0.0f);
  eachBit(dark, [&](int i) { missed[i] = 1.0f; });
  return dark;
}

/// Notes where rays of the points begin.
inline void noteRayStarts(const ShadowQuery& query, Box& rays)
{
  rays.add(
    query.patch.origin.position, (1.0 + 1e-6) * glm::dvec3(query.patch.extent) + query.errors.ray);
}

/// ... and of one at the terminator, and its way there.
inline void noteRaisedStart(const ShadowQuery& query, const TerminatorPoint& at, Box& rays)
{
  const glm::dvec3 reach(query.errors.ray);
  rays.add(query.patch.position(at.pixel), reach);
  rays.add(at.point.position, reach);
}

/// Made anew for each frame. It is asked in this order: what points will look up of the light's
/// maps is marked, the maps are traced (where processes share maps these are traced whole before),
/// patches and points are tested.
///
/// This one is of a light that casts none.
class LightShadow
{
public:
  /// `maps`: of the light, which outlive the frame. Those that find shadows by something else have
  /// them, too, where rasterised surfaces look maps up; null: there are none.
  explicit LightShadow(const LightBuffers* maps = nullptr)
    : Maps(maps)
  {
  }
  virtual ~LightShadow() = default;

  /// ShadowBuffer::mark() of all maps.
  void mark(const TilePatch& patch, LightTiles& noted) const
  {
    if (this->Maps)
    {
      this->Maps->mark(patch, noted);
    }
  }
  void trace(const ParallelFor& parallelFor) const
  {
    this->eachBuffer([&](ShadowBuffer& buffer) { buffer.trace(parallelFor); });
  }
  /// True if it can tell of the point: where there are maps, if these are traced around it.
  bool knows(const glm::dvec3& position) const
  {
    bool known = true;
    this->eachBuffer([&](const ShadowBuffer& buffer) { known = known && buffer.knows(position); });
    return known;
  }
  /// One of the light's maps' tiles.
  ShadowBuffer& bufferOf(const LightTile& tile) const
  {
    assert(this->Maps);
    return this->Maps->of(tile);
  }
  /// What it is found by, and memory. `traced`: what the maps took as well.
  void addStatistics(bool traced, FrameStatistics& statistics) const
  {
    this->count(statistics);
    this->eachBuffer(
      [&](const ShadowBuffer& buffer)
      {
        statistics.shadowMemory += buffer.memory();
        if (traced)
        {
          buffer.addStatistics(statistics);
        }
      });
  }

  /// Sets what points miss of the light, 0..1, 0 of those that are not asked; returns those that
  /// miss something. What translucent casters take is not among it.
  virtual std::uint64_t test(const ShadowQuery&, float* missed) const { return missAll(0, missed); }

  /// True if translucent casters may take something of the light.
  virtual bool dims() const { return false; }
  /// Adds what they take of the rest; Instance::translucent(). Terminators do not matter: these
  /// casters are no surfaces that points are on.
  virtual void dim(const ShadowQuery&, float*) const {}

  /// True if points at the terminator are to be found (svoTerminator.h) and asked for apart. False
  /// where nothing is in shadow, or points are compared with a map without the automatic bias.
  virtual bool knowsTerminator() const { return false; }
  /// The `grazing` of atTerminator().
  virtual double grazing() const { return 0.0; }
  /// Changes what points miss to what those at the terminator do. A raised point is lit if the way
  /// from the one on the mesh to it and on to the light is free; the first part is not looked at
  /// where it is shorter than a texel. A doubted one has to be lit by rays as well.
  virtual void testTerminator(const ShadowQuery&, const std::vector<TerminatorPoint>&, float*) const
  {
  }

  /// Notes what the answers hang on besides what was marked: where rays begin, ...
  virtual void noteRays(const ShadowQuery&, Box&) const {}
  /// ... and what else is looked up of a point at the terminator.
  virtual void noteTerminator(const ShadowQuery&, const TerminatorPoint&, Box&, RaisedTiles&) const
  {
  }

private:
  virtual void count(FrameStatistics&) const {}
  template <class F>
  void eachBuffer(const F& f) const
  {
    if (this->Maps)
    {
      this->Maps->each(f);
    }
  }

  const LightBuffers* Maps;
};

/// Adds to what points miss what something takes of the rest of those that are `left`; where
/// nothing else is in the way it is what one caster takes, to the bit.
inline void takeOfRest(std::uint64_t left, const float* taken, float* missed)
{
  eachBit(left,
    [&](int i)
    { missed[i] = missed[i] > 0.0f ? 1.0f - (1.0f - missed[i]) * (1.0f - taken[i]) : taken[i]; });
}

/// Those of the asked points that do not miss all of the light yet.
inline std::uint64_t leftOf(const ShadowQuery& query, const float* missed)
{
  std::uint64_t left = 0;
  eachBit(query.asked, [&](int i) { left |= std::uint64_t(missed[i] < 1.0f) << i; });
  return left;
}
}

#endif
