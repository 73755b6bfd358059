// Who is in front: surfaces that have the same vertices, of whatever octrees, are equally deep, and
// the later one is seen, as in VTK. Octrees round the vertices and stop at nodes; so where hits lie
// within their errors of each other, their depths are found again from the mesh's own points.
#ifndef svoHitOrder_h
#define svoHitOrder_h

#include "svoDepthBuffer.h"
#include "svoTracedInstances.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace svo
{
struct SeenHit
{
  std::uint32_t instance;
  Primitive primitive;
  double t;            // linear depth
  double x, y;         // of the image
  float floatT = 0.0f; // t minus the instance's base, where that is asked for
};

/// A tile of a view as it is merged: 64 of each.
struct MergedTile
{
  float* t; // minus the instance's base
  std::uint32_t* instance;
  Primitive* primitive;
  bool any; // else nothing is written yet
};

/// Where the image is asked through a tile: the centres of its pixels.
struct TilePoints
{
  double x[64], y[64];

  TilePoints(int tileX, int tileY)
  {
    for (int i = 0; i < 64; ++i)
    {
      this->x[i] = 8 * tileX + (i & 7) + 0.5;
      this->y[i] = 8 * tileY + (i >> 3) + 0.5;
    }
  }
};

/// An order of all hits of a view, whatever they are compared with first.
class HitOrder
{
public:
  explicit HitOrder(const TracedInstances& instances)
    : Instances(instances)
  {
  }

  /// True if one hit of a ray is in front of another one: less deep, or as deep and of the larger
  /// index.
  bool inFront(const SeenHit& a, const SeenHit& b) const
  {
    const double behind = a.t - b.t;
    if (!this->Instances.shifted() &&
      std::abs(behind) > this->Instances.error(a.instance) + this->Instances.error(b.instance))
    {
      return behind < 0.0;
    }
    return this->settle(a, b);
  }
  double linearDepth(std::uint32_t instance, float t) const
  {
    return this->Instances.base(instance) + t;
  }
  /// The linear depth beyond which a hit of `entry` cannot be in front of one of `other`.
  double lastDepth(const TracedInstance& entry, std::uint32_t other, double t) const
  {
    if (this->Instances.sloped())
    {
      return std::numeric_limits<double>::infinity(); // facets may be as steep as they like
    }
    double last = t + this->Instances.error(other);
    if (this->Instances.shifted())
    {
      last = this->Instances.view().linearDepth(
        this->rank(other, last) - this->Instances.offset(entry.index).units);
    }
    return last + this->Instances.error(entry.index);
  }
  /// Merges an instance's hits into those of a tile. Any order of merging gives the same.
  void merge(const TracedInstance& entry, const float* t, const Primitive* primitive,
    const TilePoints& at, MergedTile& merged) const;

private:
  bool settle(const SeenHit& a, const SeenHit& b) const;
  /// `primitive`: what the hit is found on; set to the triangle that it stands for.
  double exactDepth(const SeenHit& hit, Primitive& primitive) const;
  double exactRank(const SeenHit& hit) const;
  /// By what it is decided who is in front, but for slopes: an instance's linear depth, but where
  /// offsets differ.
  double rank(std::uint32_t instance, double linearDepth) const
  {
    return this->Instances.shifted()
      ? this->Instances.view().windowDepth(linearDepth) + this->Instances.offset(instance).units
      : linearDepth;
  }

  const TracedInstances& Instances;
};
}

#endif
