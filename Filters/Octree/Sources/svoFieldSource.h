// The surface where a scalar field takes a value, as a source.
//
// Whether it may pass through a cube is certain where the field's gradient has a known bound: no
// value in the cube is further from the one in the middle than bound times half the diagonal.
// Without a bound it is judged by nine samples, corners and centre: the surface is ruled out where
// all lie on one side, and the centre is further from the value than twice the largest difference
// that the cube shows between it and a corner. Of a linear field once is enough; twice stands for
// all bends that a cube of nine samples can hide. Parts of the surface that bend more than that,
// and are smaller than the coarsest cubes that are judged, can be missed: hence the bound.
//
// A voxel's plane is the field's own tangent plane near the foot of the voxel's centre: one step of
// Newton's method from the centre, and the linear rest from there. A voxel has the surface in it
// where the plane passes through it, or where the corners' values lie on both sides. Of a convex
// body both together miss nothing: seen from outside the body is behind its tangent plane, so a
// voxel that it reaches is cut by the plane; and of a voxel with its centre inside, a corner is
// outside. Where a surface bends both ways they can miss a sliver in a face of a voxel, of the
// order of its curvature times the voxel's square.
#ifndef svoFieldSource_h
#define svoFieldSource_h

#include "svoSource.h"

#include <glm/vec3.hpp>

namespace svo
{
/// A scalar field. Where it has no value it is NaN, or infinite.
class ScalarField
{
public:
  virtual ~ScalarField() = default;
  virtual double value(const glm::dvec3& at) const = 0;
  /// May be wrong where FieldOptions::gradientsAreChecked.
  virtual glm::dvec3 gradient(const glm::dvec3& at) const = 0;
};

struct FieldOptions
{
  double value = 0.0;         // that the field takes on the surface
  double gradientBound = 0.0; // largest length of the gradient; 0: not known
  double coarsest = 0.0;      // half the edge of the largest cubes that are judged by nine samples
  /// Whether differences of values decide where the field's gradient is another one than they say.
  bool gradientsAreChecked = true;
};

class VTKSVOOCTREE_EXPORT FieldSource : public SurfaceSource
{
public:
  FieldSource(const ScalarField& field, const FieldOptions& options)
    : Field(field)
    , Options(options)
  {
  }
  bool mayPass(const glm::dvec3& centre, double half) const override;
  bool planeIn(const glm::dvec3& centre, double half, SourcePlane& plane) const override;

private:
  struct Samples;
  Samples sample(const glm::dvec3& centre, double half) const;
  /// `value`: of the field at the point; `half`: of the voxel's edge.
  glm::dvec3 gradientAt(const glm::dvec3& at, double value, double half) const;
  /// True if, for certain, the cube's middle has a value too far from the surface's.
  bool tooFar(double value, double half) const;

  const ScalarField& Field;
  FieldOptions Options;
};
}

#endif
