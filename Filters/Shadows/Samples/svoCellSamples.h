// Points spread over cells, each with its share of the cell's area.
//
// A cell is cut into triangles as octrees are built from it. Two triangles that make a quad have
// their points as a square has them (svoEvenPoints.h); other cells of several triangles have in
// each as many as go with its area, which may be none. A point's share of its cell is what it
// stands for.
#ifndef svoCellSamples_h
#define svoCellSamples_h

#include "svoBuild.h"
#include "svoEvenPoints.h"
#include "svoSamples.h"

#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>

namespace svo
{
class CellSamples : public Samples
{
public:
  /// `cells`: of each triangle, not descending. The mesh is in coordinates that `toWorld` takes to
  /// the world, and outlives this object. Cells without an area, or with points that are not
  /// finite, have no samples and are in no piece.
  CellSamples(const TriangleMesh& mesh, const std::vector<std::uint32_t>& cells, int samplesPerCell,
    const glm::dmat4& toWorld);

  std::size_t placeCount() const override { return this->Cells.size(); }
  std::size_t pieces() const override { return this->Begins.size() - 1; }
  void piece(std::size_t index, std::vector<std::uint32_t>& places,
    std::vector<Sample>& samples) const override;

private:
  struct Cell
  {
    std::uint32_t id, first, end; // of its triangles
  };
  /// The points that a cell has in one of its triangles.
  struct Part
  {
    std::uint32_t triangle;
    int apex; // of a quad: the corner that the other triangle has not
    std::size_t count;
    double share; // of each point
  };
  glm::dvec3 corner(std::uint32_t triangle, int i) const;
  double area(std::uint32_t triangle) const; // 0 of one that is not finite
  double area(const Cell& cell) const;
  /// Of the triangles with an area; true if they are the halves of a quad.
  bool partsOf(const Cell& cell, std::vector<Part>& parts) const;
  bool isQuad(std::vector<Part>& parts) const;

  TriangleMesh Mesh;
  std::size_t PerCell;
  glm::dmat4 ToWorld;
  double Outside;                    // -1 where the matrix mirrors: normals keep to the outside
  std::vector<Cell> Cells;           // in the order of the pieces
  std::vector<std::uint32_t> Begins; // of the pieces in Cells; one more than there are pieces
  EvenPoints OnTriangles{ EvenPoints::Shape::Triangle };
  EvenPoints OnSquares{ EvenPoints::Shape::Square };
  std::size_t OnHalf = 0; // of a quad's points, those on its first triangle
};
}

#endif
