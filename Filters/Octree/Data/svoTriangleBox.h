// The exact overlap test of a triangle and a closed box on the lattice, after Schwarz & Seidel,
// "Fast Parallel Surface and Solid Voxelization on GPUs", 2010: plane, three projections, box.
#ifndef svoTriangleBox_h
#define svoTriangleBox_h

#include <algorithm>

#include <glm/vec3.hpp>

namespace svo
{
/// Int is std::int64_t while every difference of coordinates stays below 2^20, else __int128.
/// Degenerate triangles are exact too: where a projection has no area its edges are tested from
/// both sides, a triangle without area has no plane, an edge without length no test.
template <typename Int>
class TriangleBox
{
public:
  TriangleBox(const glm::ivec3& a, const glm::ivec3& b, const glm::ivec3& c)
    : Vertex{ a, b, c }
  {
    for (int i = 0; i < 3; ++i)
    {
      this->Low[i] = std::min({ a[i], b[i], c[i] });
      this->High[i] = std::max({ a[i], b[i], c[i] });
    }
    for (int i = 0; i < 3; ++i)
    {
      const int u = (i + 1) % 3;
      const int v = (i + 2) % 3;
      this->Normal[i] = Int(b[u] - a[u]) * (c[v] - a[v]) - Int(b[v] - a[v]) * (c[u] - a[u]);
    }
  }

  const glm::ivec3& low() const { return this->Low; }
  const glm::ivec3& high() const { return this->High; }

  /// True if the triangle and the box [low, high] have a point in common.
  bool overlaps(const glm::ivec3& low, const glm::ivec3& high) const
  {
    for (int i = 0; i < 3; ++i)
    {
      if (low[i] > this->High[i] || high[i] < this->Low[i])
      {
        return false;
      }
    }
    const glm::ivec3& a = this->Vertex[0];
    Int least = 0;
    Int most = 0;
    for (int i = 0; i < 3; ++i)
    {
      const Int n = this->Normal[i];
      least += n * ((n > 0 ? low[i] : high[i]) - a[i]);
      most += n * ((n > 0 ? high[i] : low[i]) - a[i]);
    }
    if (least > 0 || most < 0)
    {
      return false;
    }
    return this->overlapsProjected(low, high, 0) && this->overlapsProjected(low, high, 1) &&
      this->overlapsProjected(low, high, 2);
  }

private:
  bool overlapsProjected(const glm::ivec3& low, const glm::ivec3& high, int axis) const
  {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (int i = 0; i < 3; ++i)
    {
      const glm::ivec3& p = this->Vertex[i];
      const glm::ivec3& q = this->Vertex[(i + 1) % 3];
      // Left of the edge is positive; that is inside where the projected triangle turns left.
      const Int nu = p[v] - q[v];
      const Int nv = q[u] - p[u];
      const Int most =
        nu * ((nu > 0 ? high[u] : low[u]) - p[u]) + nv * ((nv > 0 ? high[v] : low[v]) - p[v]);
      const Int least =
        nu * ((nu > 0 ? low[u] : high[u]) - p[u]) + nv * ((nv > 0 ? low[v] : high[v]) - p[v]);
      if ((this->Normal[axis] >= 0 && most < 0) || (this->Normal[axis] <= 0 && least > 0))
      {
        return false;
      }
    }
    return true;
  }

  glm::ivec3 Vertex[3];
  glm::ivec3 Low, High;
  Int Normal[3];
};
}

#endif
