// The builder's oracle: overlap of a triangle and a box by all thirteen separating axes, in exact
// integers, written without looking at the builder's own test.
#ifndef svoSeparatingAxes_h
#define svoSeparatingAxes_h

#include <algorithm>

#include <glm/vec3.hpp>

namespace svotest
{
using Wide = __int128;

struct WideVector
{
  Wide x, y, z;
};

inline WideVector cross(const WideVector& a, const WideVector& b)
{
  return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

inline Wide dot(const WideVector& a, const WideVector& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// True if the closed box [low, high] and the closed triangle have a point in common.
inline bool overlapBySeparatingAxes(
  const glm::ivec3 vertices[3], const glm::ivec3& low, const glm::ivec3& high)
{
  WideVector v[3];
  for (int i = 0; i < 3; ++i)
  {
    v[i] = { vertices[i].x, vertices[i].y, vertices[i].z };
  }
  const auto edge = [&](int i) -> WideVector
  {
    const WideVector &a = v[i], &b = v[(i + 1) % 3];
    return { b.x - a.x, b.y - a.y, b.z - a.z };
  };
  const WideVector unit[3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  WideVector axes[13] = { unit[0], unit[1], unit[2], cross(edge(0), edge(1)) };
  for (int i = 0; i < 9; ++i)
  {
    axes[4 + i] = cross(unit[i / 3], edge(i % 3));
  }
  for (const WideVector& axis : axes)
  {
    Wide boxLow = 0;
    Wide boxHigh = 0;
    for (int corner = 0; corner < 8; ++corner)
    {
      const Wide at = dot(axis,
        { corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z });
      boxLow = corner == 0 ? at : std::min(boxLow, at);
      boxHigh = corner == 0 ? at : std::max(boxHigh, at);
    }
    const Wide at[3] = { dot(axis, v[0]), dot(axis, v[1]), dot(axis, v[2]) };
    if (std::min({ at[0], at[1], at[2] }) > boxHigh || std::max({ at[0], at[1], at[2] }) < boxLow)
    {
      return false;
    }
  }
  return true;
}
}

#endif
