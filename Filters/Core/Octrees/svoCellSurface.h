// The surface of an octree's cells: quads that face outwards and share points.
#ifndef svoCellSurface_h
#define svoCellSurface_h

#include "svoOctreeCells.h"
#include "vtkSVOCoreModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

class vtkPolyData;

namespace svo
{
/// The faces of a cell: which neighbour they look at, and their corners, counter-clockwise seen
/// from there.
struct CellFace
{
  glm::ivec3 neighbour;
  glm::ivec3 corners[4];
};
constexpr int CellFaces = 6;
inline const CellFace FacesOfCell[CellFaces] = {
  { { -1, 0, 0 }, { { 0, 0, 0 }, { 0, 0, 1 }, { 0, 1, 1 }, { 0, 1, 0 } } },
  { { 1, 0, 0 }, { { 1, 0, 0 }, { 1, 1, 0 }, { 1, 1, 1 }, { 1, 0, 1 } } },
  { { 0, -1, 0 }, { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 1 }, { 0, 0, 1 } } },
  { { 0, 1, 0 }, { { 0, 1, 0 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, 1, 0 } } },
  { { 0, 0, -1 }, { { 0, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 1, 0, 0 } } },
  { { 0, 0, 1 }, { { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } } },
};

/// False if the neighbour `at` of a cell of the level is empty.
VTKSVOCORE_EXPORT bool isOccupied(
  const Octree& octree, const OctreeCell& cell, const glm::ivec3& at, int level);

/// Calls visit(cell, faces), a bit for each face that is shown, for every cell that shows any,
/// until it returns false. `interior`: faces between two occupied cells are shown, too.
template <class Visit>
bool forEachVisibleCell(const Octree& octree, int level, bool interior, const Visit& visit)
{
  return forEachCell(octree, level,
    [&](const OctreeCell& cell)
    {
      int faces = 0;
      for (int f = 0; f < CellFaces; ++f)
      {
        if (interior || !isOccupied(octree, cell, cell.cell + FacesOfCell[f].neighbour, level))
        {
          faces |= 1 << f;
        }
      }
      return faces == 0 || visit(cell, faces);
    });
}

/// Corners of quads, four each.
class CellQuads
{
public:
  /// Bytes that a quad takes until it is part of a mesh.
  static constexpr std::size_t Bytes = 4 * 16 + 4 * 8 + 24;

  void reserve(std::size_t quads) { this->Corners.reserve(4 * quads); }
  /// Those faces of a cell that `faces` has bits for.
  void add(const glm::ivec3& cell, int faces);
  /// Writes points (of VTK's type `pointType`) and polygons of a mesh, in the octree's local
  /// coordinates. `sorted` is called when the longer half of the work is done.
  void write(
    const Octree& octree, int level, int pointType, vtkPolyData* mesh,
    const std::function<void()>& sorted = [] {}) const;

private:
  std::vector<std::uint64_t> Corners;
};
}

#endif
