// Who is seen: what those behind the hits of a view, and the order of its hits, have to know of the
// scene's instances.
#ifndef svoViewedInstances_h
#define svoViewedInstances_h

#include "svoScene.h"
#include "svoView.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
/// One of them; what is not seen has zeros, but for the leaf geometry.
struct ViewedInstance
{
  double base = 0.0;  // linear depth that the t of its hits are measured from
  double error = 0.0; // of t, within which t does not tell who is in front; 0: it always does
  int level = 0;
  LeafGeometry leafGeometry = LeafGeometry::Automatic; // what its rays end on
  bool placed = false;                                 // all its hits are placed in double
  PixelRect rect;                                      // whole tiles that may see it
};

/// Asked by index into Scene::instances. Made once a frame, then read by all threads. Arrays, since
/// loops over pixels ask.
class ViewedInstances
{
public:
  double base(std::uint32_t instance) const
  {
    assert(instance < this->Bases.size());
    return this->Bases[instance];
  }
  double error(std::uint32_t instance) const { return this->Errors[instance]; }
  int level(std::uint32_t instance) const { return this->Levels[instance]; }
  /// Of all of the scene.
  LeafGeometry leafGeometry(std::uint32_t instance) const { return this->Geometries[instance]; }
  const DepthOffset& offset(std::uint32_t instance) const { return this->Offsets[instance]; }
  bool placed(std::uint32_t instance) const { return this->Placed[instance] != 0; }
  /// Of the eye's view only.
  const PixelRect& rect(std::uint32_t instance) const
  {
    assert(instance < this->Rects.size());
    return this->Rects[instance];
  }

  /// Those of a scene, of which none is seen yet. `rects`: whether they are to be had.
  void assign(const Scene& scene, bool rects)
  {
    const std::size_t count = scene.instances.size();
    this->Bases.assign(count, 0.0);
    this->Errors.assign(count, 0.0);
    this->Levels.assign(count, 0);
    this->Placed.assign(count, 0);
    this->Rects.assign(rects ? count : 0, PixelRect());
    this->Geometries.clear();
    this->Offsets.clear();
    for (const Instance& instance : scene.instances)
    {
      this->Geometries.push_back(instance.body->leafGeometry);
      this->Offsets.push_back(instance.depthOffset);
    }
  }
  /// Threads may say so of different ones.
  void setSeen(std::uint32_t instance, const ViewedInstance& seen)
  {
    this->Bases[instance] = seen.base;
    this->Errors[instance] = seen.error;
    this->Levels[instance] = seen.level;
    this->Geometries[instance] = seen.leafGeometry;
    this->Placed[instance] = seen.placed;
    if (!this->Rects.empty())
    {
      this->Rects[instance] = seen.rect;
    }
  }

private:
  std::vector<double> Bases, Errors;
  std::vector<int> Levels;
  std::vector<LeafGeometry> Geometries;
  std::vector<std::uint8_t> Placed;
  std::vector<PixelRect> Rects;
  std::vector<DepthOffset> Offsets;
};
}

#endif
