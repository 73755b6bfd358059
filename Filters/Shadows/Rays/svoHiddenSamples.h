// Which samples a scene's casters hide from a light.
//
// Octrees of meshes are met at their triangles, exactly, in double, whatever leaf geometry they are
// for; octrees of planes at their planes. Samples go to a light as one beam (svoShadowBeam.h), or,
// where that sees too much, as a block of rays (svoIntersect.h). Either is told from rays in
// double by floats' rounding at edges only: what is dark is so in double, and what a beam or a
// block leaves open, or says of a sample's own surface, is asked for by a ray in double.
#ifndef svoHiddenSamples_h
#define svoHiddenSamples_h

#include "svoLight.h"
#include "svoRayCasters.h"
#include "svoSamples.h"
#include "svoScene.h"

#include <cstdint>

#include <glm/mat4x4.hpp>

namespace svo
{
/// What samples lie on.
struct OwnMesh
{
  static constexpr std::uint32_t None = ~0u;
  std::uint32_t instance = None; // index in the scene, where it casts
  bool points = false;           // Sample::own names a point of it; else a triangle
  double error = 0.0;            // triangleError() of the instance
};

/// How far an instance's triangles may be from where the mesh has them, world. (A ray that starts
/// as a double starts nearer than RayCaster::floatError.)
double triangleError(const Instance& instance);

/// Adds a caster. The matrix is finite and has an inverse. Returns its index; OwnMesh::None, and
/// nothing is added, if the octree is empty.
std::uint32_t addCaster(const Octree& octree, const glm::dmat4& toWorld, Scene& scene);

/// Of up to 64 samples those, of `asked`, that a caster hides from the light; one bit each. A ray
/// starts off its surface, along the normal on the light's side, by what the floats of the caster
/// and of the samples' own mesh resolve, and never meets the sample's own triangle, or a triangle
/// that has a corner in the sample's point. Single rays: no beams, for comparison.
std::uint64_t hiddenSamples(const RayCasters& casters, const OwnMesh& own, const Light& light,
  const Sample* samples, int count, std::uint64_t asked, bool singleRays = false);
}

#endif
