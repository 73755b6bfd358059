// Exact visibility from triangles, by a ray tracer that is not ours.
#ifndef accuracyReference_h
#define accuracyReference_h

#include "accuracyStage.h"

#include <memory>
#include <vector>

namespace accuracy
{
constexpr int NoObject = -1;

/// What a ray from the eye meets first.
struct ExactHit
{
  int object = NoObject;
  unsigned triangle = 0;
  double t = 0.0;           // linear depth
  glm::dvec3 point{ 0.0 };  // world
  glm::dvec3 normal{ 0.0 }; // world, unit, of the triangle's plane, towards the eye
  explicit operator bool() const { return this->object != NoObject; }
};

/// Embree finds the triangle (robust mode, single precision); where the ray meets the triangle's
/// plane is then computed in double from the triangle's own points. A ray on which a method and
/// Embree disagree about hit or miss can be settled by testing every triangle in double.
class Reference
{
public:
  explicit Reference(const Stage& stage);
  ~Reference();
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

  /// The ray through point (x, y) of the image, in pixels from its lower left corner.
  ExactHit first(const svo::View& view, double x, double y) const;
  /// The same with every triangle in double precision; slow.
  ExactHit settle(const svo::View& view, double x, double y) const;
  /// True if a triangle lies between the light and a point of a surface whose normal is given. The
  /// ray starts 4e-6 beside the surface, on the light's side.
  bool blocked(const glm::dvec3& point, const glm::dvec3& normal, const svo::Light& light) const;

private:
  ExactHit onPlane(const svo::View& view, double x, double y, int object, unsigned triangle) const;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

/// Unit vector from a point to a light.
glm::dvec3 towards(const svo::Light& light, const glm::dvec3& point);
/// False outside of a spot's cone.
bool reaches(const svo::Light& light, const glm::dvec3& point);

/// What the exact picture knows of a pixel's centre.
struct TruePixel
{
  ExactHit hit;
  float facing = 0.0f; // n.v
  float lit = 0.0f;    // n.l of the stage's first light; 0 where it does not reach
  bool dark = false;   // the light would reach the pixel, were it not for another surface
  bool atEdge = false; // within a pixel of a depth discontinuity
};

/// The stage as exact rays see it, row by row from the lower left. `shadows`: of the first light.
std::vector<TruePixel> exactPicture(
  const Reference& reference, const Stage& stage, const svo::View& view, bool shadows);
}

#endif
