// Octrees with their matrices that may stand between samples and lights.
//
// Octrees of meshes are met at their triangles, exactly, in double, whatever leaf geometry they are
// for; octrees of planes at their planes. Samples go to a light as one beam (svoShadowBeam.h), or,
// where that sees too much, as a block of rays (svoIntersect.h). Either is told from rays in
// double by floats' rounding at edges only: what is dark is so in double, and what a beam or a
// block leaves open, or says of a sample's own surface, is asked for by a ray in double.
#ifndef svoShadowCasters_h
#define svoShadowCasters_h

#include "svoCasterBox.h"
#include "svoLight.h"
#include "svoOctree.h"
#include "svoRay.h"
#include "svoSamples.h"
#include "svoWorldToOctree.h"

#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>

namespace svo
{
struct ShadowCaster
{
  /// What the samples lie on, of it.
  enum class Own
  {
    Nothing,
    Triangles, // Sample::own names a triangle of it
    Points     // Sample::own names a point of it
  };

  Octree octree;
  WorldToOctree toOctree;
  CasterBox box;
  double error; // world; how far a triangle may be from where the mesh has it
  Own own;
};

class ShadowCasters
{
public:
  using Own = ShadowCaster::Own;

  /// The matrix is finite and has an inverse. An octree that is empty is no caster.
  void add(const Octree& octree, const glm::dmat4& toWorld, Own own);

  /// Of up to 64 samples those, of `asked`, that a caster hides from the light; one bit each. A ray
  /// starts off its surface, along the normal on the light's side, by what the floats of the caster
  /// and of the samples' own mesh resolve, and never meets the sample's own triangle, or a triangle
  /// that has a corner in the sample's point. Single rays: no beams, for comparison.
  std::uint64_t hidden(const Light& light, const Sample* samples, int count, std::uint64_t asked,
    bool singleRays = false) const;

private:
  std::vector<ShadowCaster> Casters;
  double OwnError = 0.0;
};
}

#endif
