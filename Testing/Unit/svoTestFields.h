// Scalar fields with known surfaces, and their octrees of planes.
#ifndef svoTestFields_h
#define svoTestFields_h

#include "svoFieldSource.h"
#include "svoOctree.h"

#include <cmath>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace svotest
{
/// Zero on a sphere around `centre`: the squared distance from the centre, less that of the
/// surface, which is no distance from the surface.
struct SphereField : svo::ScalarField
{
  explicit SphereField(double r, const glm::dvec3& c = glm::dvec3(0.0))
    : radius(r)
    , centre(c)
  {
  }
  double value(const glm::dvec3& at) const override
  {
    return glm::dot(at - centre, at - centre) - radius * radius;
  }
  glm::dvec3 gradient(const glm::dvec3& at) const override { return 2.0 * (at - centre); }

  double radius;
  glm::dvec3 centre;
};

inline svo::BuildOptions boxOfInterest(int level, double half = 1.0)
{
  svo::BuildOptions options;
  options.level = level;
  options.leafGeometry = svo::LeafGeometry::Plane;
  options.modelLow = glm::dvec3(-half);
  options.modelHigh = glm::dvec3(half);
  return options;
}

inline svo::Octree openPlanes(const svo::BuildResult& result)
{
  std::string error;
  const svo::Octree octree = svo::Octree::open(result.data, result.size, nullptr, error);
  EXPECT_TRUE(octree) << result.message << error;
  return octree;
}

inline svo::Octree octreeOfField(
  const svo::ScalarField& field, const svo::BuildOptions& options, double gradientBound = 0.0)
{
  const svo::FieldSource source(
    field, { 0.0, gradientBound, std::ldexp(options.modelHigh.x - options.modelLow.x, -6) });
  return openPlanes(svo::build(source, options));
}
}

#endif
