// The casters of a scene, for rays of any kind: which of them may be on the way.
#ifndef svoRayCasters_h
#define svoRayCasters_h

#include "svoCasterBox.h"
#include "svoLooseOctree.h"
#include "svoScene.h"
#include "svoSurfacePoint.h"
#include "svoViewedInstances.h"
#include "svoWorldToOctree.h"
#include "vtkSVOTracingModule.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
struct RayCaster
{
  const Instance* instance;
  std::uint32_t index; // of the instance
  LeafGeometry geometry;
  WorldToOctree toOctree;
  double planeError; // world; how far plane leaves among triangles can be off, 0 without any
  double leafError;  // world; how far any leaf can be off
  bool beams;        // all leaves are triangles
  CasterBox box;
  SurfaceMatrices matrices; // where its opacity is mapped
  double floatError;        // world; what floats do not tell apart on it

  /// How far off their surface rays in float have to begin for it, world; `own`: it is that of the
  /// points.
  double startOffset(double offset, bool own) const
  {
    return std::max({ offset, this->planeError, own ? this->floatError : 0.0 });
  }
};

/// How opaque the caster is where light meets it first that comes to `end` from `length` times
/// `towards` (world; not unit; a length of 1e30 or more: from beyond the caster): 0 if nowhere.
VTKSVOTRACING_EXPORT float opacityMet(
  const RayCaster& caster, const glm::dvec3& end, const glm::dvec3& towards, double length);

class VTKSVOTRACING_EXPORT RayCasters
{
public:
  /// `seen`: their leaf geometries, as a view has them. `tree`: of the scene's instances
  /// (svoInstanceTree.h); null: each ray looks at each caster. Scene and tree are borrowed.
  RayCasters(const Scene& scene, const ViewedInstances& seen, const LooseOctree* tree = nullptr);

  const std::vector<RayCaster>& translucent() const { return this->Translucent; }

  /// Calls visit(caster) for opaque ones on the way, until one of them says true; that is
  /// the answer. In one order, with a tree and without.
  template <class Visit>
  bool anyOpaque(const BoxWay& way, const Visit& visit) const;

  /// Calls visit(caster) for opaque ones; with a tree only for those in cubes that
  /// reach(centre, extent) says of that something comes to them (world), near to `from` first.
  template <class Reach, class Visit>
  void eachOpaque(const glm::dvec3& from, const Reach& reach, const Visit& visit) const;

  /// The most that RayCaster::startOffset() adds, world.
  double mostStartOffset() const { return this->MostStartOffset; }

private:
  std::vector<RayCaster> Opaque, Translucent;
  double MostStartOffset = 0.0;
  const LooseOctree* Tree;
  std::vector<std::uint32_t> Casting; // by index of the instance: index into Opaque, or None
  static constexpr std::uint32_t None = ~0u;
};

template <class Visit>
bool RayCasters::anyOpaque(const BoxWay& way, const Visit& visit) const
{
  if (!this->Tree)
  {
    return std::any_of(this->Opaque.begin(), this->Opaque.end(),
      [&](const RayCaster& caster) { return caster.box.mayMeet(way) && visit(caster); });
  }
  // In the order in which they are asked without a tree: where a beam passes an edge as closely as
  // floats tell, the answer is that of the points which are asked together.
  std::vector<std::uint32_t> asked;
  this->Tree->visit(
    VisitOrder{ way.middle },
    [&](const LooseNode& node, std::uint8_t&)
    { return CasterBox(node.centre, node.half).mayMeet(way); },
    [&](std::uint32_t object)
    {
      const std::uint32_t k = this->Casting[object];
      if (k != None && this->Opaque[k].box.mayMeet(way))
      {
        asked.push_back(k);
      }
    });
  std::sort(asked.begin(), asked.end());
  return std::any_of(
    asked.begin(), asked.end(), [&](std::uint32_t k) { return visit(this->Opaque[k]); });
}

template <class Reach, class Visit>
void RayCasters::eachOpaque(const glm::dvec3& from, const Reach& reach, const Visit& visit) const
{
  if (!this->Tree)
  {
    std::for_each(this->Opaque.begin(), this->Opaque.end(), visit);
    return;
  }
  this->Tree->visit(
    VisitOrder{ from },
    [&](const LooseNode& node, std::uint8_t&) { return reach(node.centre, glm::dvec3(node.half)); },
    [&](std::uint32_t object)
    {
      const std::uint32_t k = this->Casting[object];
      if (k != None)
      {
        visit(this->Opaque[k]);
      }
    });
}
}

#endif
