// Points spread over cells, each with its share of the cell's area.
//
// A cell is cut into triangles as octrees are built from it. Each has a share of the samples that
// goes with its area, and at least one: a lattice of the golden ratio (J. H. Hannay, J. F. Nye,
// "Fibonacci numerical integration on a sphere", J. Phys. A 37, 2004) on a square that a square
// root takes to the triangle (P. Shirley, Graphics Gems III, 1992), which leaves no straight rows:
// edges of shadows that run along edges of cells are counted as well as any.
#ifndef svoCellSamples_h
#define svoCellSamples_h

#include "svoBuild.h"
#include "svoSamples.h"

#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>

namespace svo
{
class CellSamples : public Samples
{
public:
  /// `cells`: of each triangle, not descending. The mesh is in a frame that `toWorld` takes to the
  /// world, and outlives this object. Cells without an area, or with points that are not finite,
  /// have no samples and are in no piece.
  CellSamples(const TriangleMesh& mesh, const std::vector<std::uint32_t>& cells, int samplesPerCell,
    const glm::dmat4& toWorld);

  std::size_t pieces() const override { return this->Begins.size() - 1; }
  void piece(std::size_t index, std::vector<std::uint32_t>& places,
    std::vector<Sample>& samples) const override;

  /// How many cells have samples.
  std::size_t cellCount() const { return this->Cells.size(); }

private:
  struct Cell
  {
    std::uint32_t id, first, end; // of its triangles
  };
  glm::dvec3 corner(std::uint32_t triangle, int i) const;
  double area(std::uint32_t triangle) const; // 0 of one that is not finite
  double area(const Cell& cell) const;
  std::size_t samplesOf(double part) const;

  TriangleMesh Mesh;
  int PerCell;
  glm::dmat4 ToWorld;
  double Outside;                    // -1 where the matrix mirrors: normals keep to the outside
  std::vector<Cell> Cells;           // in the order of the pieces
  std::vector<std::uint32_t> Begins; // of the pieces in Cells; one more than there are pieces
};

/// Barycentric coordinates of point `index` of `count` in a triangle; of one alone, the middle.
glm::dvec3 trianglePoint(std::size_t index, std::size_t count);
}

#endif
