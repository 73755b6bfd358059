#include "svoLightContour.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace svo
{
namespace
{
constexpr std::int8_t Mixed = 2;
constexpr double Rounding = 1e-9; // radians

/// True if the triangle is wound to the left as the light sees it.
bool faces(const Surface& surface, std::uint32_t face, const glm::dvec4& light)
{
  const TrianglePlane plane(surface, face);
  return glm::dot(plane.normal, glm::dvec3(light) - light.w * plane.p) > 0.0;
}

/// 1 if all of a bundle faces the light wherever it lies on the mesh, -1 if nothing does, else
/// Mixed.
std::int8_t senseOf(const MeshEdges& mesh, const MeshEdges::Bundle& bundle, const glm::dvec4& light)
{
  const glm::dvec3 way = glm::dvec3(light) - light.w * mesh.centre;
  const double length = glm::length(way);
  // How far ways from other points of the mesh turn aside.
  const double sine = light.w * mesh.radius / length;
  if (!(sine < 1.0))
  {
    return Mixed;
  }
  const double between = std::acos(std::clamp(glm::dot(bundle.axis, way) / length, -1.0, 1.0));
  const double most = bundle.angle + std::asin(sine) + Rounding;
  constexpr double Right = 1.57079632679489662;
  return between + most < Right ? 1 : between - most > Right ? -1 : Mixed;
}
}

bool LightContour::update(
  const Surface& surface, const MeshEdges& mesh, const glm::dvec4& light, bool bundles)
{
  const bool fresh = this->Senses.size() != mesh.faces.size();
  if (fresh)
  {
    this->Senses.assign(mesh.faces.size(), 0);
    this->Whole.assign(mesh.bundles.size(), Mixed);
    this->Counts.assign(mesh.edges.size(), 0);
  }
  // From inside all triangles of a solid part may face away.
  const bool outside =
    light.w == 0.0 || glm::distance(glm::dvec3(light), mesh.centre) > mesh.radius;
  if (outside != this->Outside)
  {
    this->Whole.assign(mesh.bundles.size(), Mixed);
    this->Outside = outside;
  }
  const auto senseAway = [&](std::uint32_t face)
  { return outside && mesh.faces[face].solid ? 0 : -1; };
  this->Asked = this->Turned = 0;
  std::uint32_t end = 0;
  for (std::size_t i = 0; i < mesh.bundles.size(); ++i)
  {
    const MeshEdges::Bundle& bundle = mesh.bundles[i];
    end = bundle.end;
    const std::int8_t whole = bundles ? senseOf(mesh, bundle, light) : Mixed;
    if (whole != Mixed && whole == this->Whole[i])
    {
      continue;
    }
    this->Whole[i] = whole;
    for (std::uint32_t k = bundle.first; k < bundle.end; ++k)
    {
      const std::uint32_t face = mesh.bundled[k];
      this->Asked += whole == Mixed;
      const bool towards = whole == Mixed ? faces(surface, face, light) : whole > 0;
      this->turn(mesh, face, towards ? 1 : senseAway(face));
    }
  }
  for (std::size_t k = end; k < mesh.bundled.size(); ++k)
  {
    this->turn(mesh, mesh.bundled[k], senseAway(mesh.bundled[k]));
  }
  if (this->Turned > 0)
  {
    this->collect(mesh);
  }
  return this->Turned > 0;
}

/// Gives a face another sense.
void LightContour::turn(const MeshEdges& mesh, std::uint32_t face, int sense)
{
  const int more = sense - this->Senses[face];
  if (more == 0)
  {
    return;
  }
  ++this->Turned;
  this->Senses[face] = static_cast<std::int8_t>(sense);
  for (const std::uint32_t edge : mesh.faces[face].edges)
  {
    if (edge != MeshEdges::None)
    {
      this->Counts[edge / 2] += edge & 1 ? -more : more;
    }
  }
}

void LightContour::collect(const MeshEdges& mesh)
{
  this->Edges.clear();
  for (std::size_t i = 0; i < mesh.edges.size(); ++i)
  {
    const Edge& edge = mesh.edges[i];
    const int count = this->Counts[i];
    this->Edges.insert(this->Edges.end(), static_cast<std::size_t>(std::abs(count)),
      count > 0 ? edge : Edge{ edge.to, edge.from });
  }
}

std::vector<std::uint32_t> LightContour::senses() const
{
  std::vector<std::uint32_t> words((this->Senses.size() + 15) / 16);
  for (std::size_t face = 0; face < this->Senses.size(); ++face)
  {
    const std::uint32_t sense =
      this->Senses[face] < 0 ? 2u : static_cast<std::uint32_t>(this->Senses[face]);
    words[face / 16] |= sense << 2 * (face % 16);
  }
  return words;
}

void LightContour::forget()
{
  this->Senses = {};
  this->Whole = {};
  this->Counts = {};
}

std::size_t LightContour::bytes() const
{
  return this->Senses.size() + this->Whole.size() + this->Counts.size() * sizeof(std::int32_t) +
    this->Edges.capacity() * sizeof(Edge);
}
}
