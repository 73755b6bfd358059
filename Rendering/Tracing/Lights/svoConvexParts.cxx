#include "svoConvexParts.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
using Polygon = std::vector<glm::dvec3>;

std::vector<ConvexFace> facesOf(const ConvexBody& body)
{
  glm::dvec3 middle(0.0);
  for (const glm::dvec3& corner : body)
  {
    middle += 0.125 * corner;
  }
  std::vector<ConvexFace> faces;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
    for (const int first : { 0, 1 << axis })
    {
      const Polygon polygon{ body[first], body[first | u], body[first | u | v], body[first | v] };
      const glm::dvec3 diagonal = polygon[2] - polygon[0];
      glm::dvec3 normal = glm::cross(diagonal, polygon[3] - polygon[1]);
      const double length = glm::length(normal);
      if (!(length > 0.0) || !std::isfinite(length))
      {
        continue; // no more than an edge
      }
      normal /= length;
      const double side = glm::dot(normal, middle - polygon[0]);
      normal = side < 0.0 ? -normal : normal;
      const bool flat = std::abs(side) <= 1e-12 * glm::length(diagonal);
      faces.push_back({ polygon, normal, glm::dot(normal, polygon[0]), flat });
    }
  }
  return faces;
}

bool isFlat(const std::vector<ConvexFace>& faces)
{
  return std::any_of(faces.begin(), faces.end(), [](const ConvexFace& face) { return face.flat; });
}

void clip(Polygon& polygon, const ConvexFace& side, Polygon& scratch)
{
  scratch.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const glm::dvec3& a = polygon[i];
    const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
    const double da = glm::dot(side.normal, a) - side.offset;
    const double db = glm::dot(side.normal, b) - side.offset;
    if (da >= 0.0)
    {
      scratch.push_back(a);
    }
    if ((da >= 0.0) != (db >= 0.0))
    {
      scratch.push_back(a + da / (da - db) * (b - a));
    }
  }
  polygon.swap(scratch);
}
}

ConvexBody pieceOf(const View& view, double nearest, double farthest)
{
  assert(nearest <= farthest);
  ConvexBody body;
  for (int i = 0; i < 8; ++i)
  {
    const double x = i & 1 ? view.crop.x1 : view.crop.x0;
    const double y = i & 2 ? view.crop.y1 : view.crop.y0;
    body[i] = view.rayOrigin(x, y) + (i & 4 ? farthest : nearest) * view.rayDirection(x, y);
  }
  return body;
}

CommonPart::CommonPart(const std::vector<ConvexBody>& bodies)
{
  for (const ConvexBody& body : bodies)
  {
    this->Faces.push_back(facesOf(body));
  }
}

void CommonPart::add(const ConvexBody& body, std::vector<glm::dvec3>& points) const
{
  // Nearly all bodies lie beyond one face, or before all of them.
  bool within = true;
  for (const std::vector<ConvexFace>& faces : this->Faces)
  {
    for (const ConvexFace& face : faces)
    {
      int before = 0, beyond = 0;
      for (const glm::dvec3& corner : body)
      {
        const double side = glm::dot(face.normal, corner) - face.offset;
        before += side >= 0.0;
        beyond += side < 0.0;
      }
      if (beyond == 8 && !face.flat)
      {
        return;
      }
      within = within && before == 8 && !face.flat;
    }
  }
  if (within)
  {
    points.insert(points.end(), body.begin(), body.end());
    return;
  }
  std::vector<std::vector<ConvexFace>> all{ facesOf(body) };
  all.insert(all.end(), this->Faces.begin(), this->Faces.end());
  // A flat one, if there is one, holds all of the common part.
  const auto flat =
    static_cast<std::size_t>(std::find_if(all.begin(), all.end(), isFlat) - all.begin());
  // The corners of the common part lie on faces of some body, inside of all others.
  Polygon scratch;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    for (const ConvexFace& face : all[i])
    {
      if (flat < all.size() && (i != flat || !face.flat))
      {
        continue;
      }
      Polygon polygon = face.polygon;
      for (std::size_t k = 0; k < all.size() && !polygon.empty(); ++k)
      {
        for (const ConvexFace& other : all[k])
        {
          if (k != i && !other.flat)
          {
            clip(polygon, other, scratch);
          }
        }
      }
      points.insert(points.end(), polygon.begin(), polygon.end());
    }
  }
}
}
