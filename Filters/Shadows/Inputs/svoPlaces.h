// VTK's matrices as places of meshes in the world.
#ifndef svoPlaces_h
#define svoPlaces_h

#include "svoInverse.h"

#include "vtkMatrix4x4.h"

#include <glm/mat4x4.hpp>

namespace svo
{
/// nullptr: the identity.
inline glm::dmat4 matrixOf(vtkMatrix4x4* matrix)
{
  glm::dmat4 m(1.0);
  for (int i = 0; matrix && i < 16; ++i)
  {
    m[i % 4][i / 4] = matrix->GetElement(i / 4, i % 4);
  }
  return m;
}

/// True if a matrix takes all points to points, each to one of its own.
inline bool isPlace(const glm::dmat4& m)
{
  return placesSomething(m) && m[0][3] == 0.0 && m[1][3] == 0.0 && m[2][3] == 0.0 && m[3][3] == 1.0;
}
}

#endif
