#include "svoSurfacePoint.h"

namespace svo
{
void turnAsShaders(const SurfaceMatrices& frame, const View& view, SurfacePoint& point)
{
  const Attributes& attributes = frame.instance->attributes;
  bool other = view.mirrored;
  if (!attributes.normals ||
    (frame.instance->material.flat && attributes.normalAssociation != Association::Cell))
  {
    const glm::dvec3 along = view.facetsFaceAxis ? view.axis : point.position - view.eye;
    other = glm::dot(glm::dvec3(point.facet), along) > 0.0;
  }
  if (other)
  {
    point.normal = -point.normal;
  }
}
}
