#include "svoLeafValues.h"

#include "svoCellIds.h"
#include "svoCellSurface.h"
#include "svoKnownRange.h"
#include "svoMeshOctree.h"
#include "svoNode.h"
#include "svoOctreeCells.h"
#include "svoPlane.h"
#include "svoSourceOctree.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <string>
#include <vector>

#include <glm/common.hpp>

namespace svo
{
namespace
{

struct Brick
{
  glm::ivec3 firstVoxel;
  std::uint32_t node;
};

std::vector<Brick> bricksOf(const Octree& octree)
{
  if (octree.brickLevel() < 0)
  {
    return { { glm::ivec3(0), 0 } };
  }
  std::vector<Brick> bricks;
  bricks.reserve(octree.header().nodeCount - octree.brickBegin());
  forEachCell(octree, octree.brickLevel(),
    [&](const OctreeCell& c)
    {
      bricks.push_back(
        { NodeEdge * c.cell, c.above == 0 ? child(octree.nodes()[c.node], c.firstBit) : c.node });
      return true;
    });
  return bricks;
}

/// Means over the cells of `level`, in the order of the cells.
std::vector<double> meansOf(const Octree& octree, int level, vtkDataArray* values)
{
  const int components = values->GetNumberOfComponents();
  const int below = octree.level() - level;
  std::vector<double> sums;
  glm::ivec3 current(-1);
  vtkIdType count = 0, leaf = 0;
  const auto finish = [&]
  {
    for (int c = 0; c < components && count > 0; ++c)
    {
      sums[sums.size() - components + c] /= static_cast<double>(count);
    }
  };
  std::vector<double> tuple(components);
  forEachCell(octree, octree.level(),
    [&](const OctreeCell& voxel)
    {
      const glm::ivec3 cell = voxel.cell >> below;
      if (cell != current)
      {
        finish();
        current = cell;
        count = 0;
        sums.resize(sums.size() + components, 0.0);
      }
      values->GetTuple(leaf++, tuple.data());
      ++count;
      for (int c = 0; c < components; ++c)
      {
        sums[sums.size() - components + c] += tuple[c];
      }
      return true;
    });
  finish();
  return sums;
}

/// Cell data for the quads of a contour: means of the cells that they join; of its pieces, which
/// have one cell each.
void averageQuads(
  vtkPolyData* mesh, const std::vector<double>& means, int components, vtkDataArray* array)
{
  const auto cells = static_cast<vtkIdType>(means.size()) / components;
  std::vector<double> sum(components);
  vtkIdType quad = 0;
  useCellIds(mesh->GetPolys(),
    [&](const auto* offsets, const auto* ids)
    {
      for (; quad < array->GetNumberOfTuples(); ++quad)
      {
        int count = 0;
        std::fill(sum.begin(), sum.end(), 0.0);
        for (auto i = offsets[quad]; i < offsets[quad + 1]; ++i)
        {
          if (ids[i] < cells)
          {
            ++count;
            for (int c = 0; c < components; ++c)
            {
              sum[c] += means[static_cast<std::size_t>(ids[i]) * components + c];
            }
          }
        }
        for (double& value : sum)
        {
          value /= count;
        }
        array->SetTuple(quad, sum.data());
      }
    });
}

/// Cell data for the faces of cells, in their order.
void repeatForFaces(
  const Octree& octree, int level, const std::vector<double>& means, vtkDataArray* array)
{
  vtkIdType quad = 0;
  std::size_t index = 0;
  forEachCell(octree, level,
    [&](const OctreeCell& cell)
    {
      for (const CellFace& face : FacesOfCell)
      {
        if (!isOccupied(octree, cell, cell.cell + face.neighbour, level))
        {
          array->SetTuple(quad++, means.data() + index);
        }
      }
      index += static_cast<std::size_t>(array->GetNumberOfComponents());
      return true;
    });
}
}

bool forEachLeaf(const Octree& octree, const ParallelFor& parallelFor,
  const std::function<bool(double)>& progress,
  const std::function<void(std::size_t, const glm::dvec3&)>& visit)
{
  constexpr std::size_t Chunk = 1 << 16;
  if (octree.empty())
  {
    return true;
  }
  const Header& h = octree.header();
  const glm::dvec3 origin(h.origin[0], h.origin[1], h.origin[2]);
  const std::vector<Brick> bricks = bricksOf(octree);
  for (std::size_t begin = 0; begin < bricks.size(); begin += Chunk)
  {
    forEach(parallelFor, std::min(Chunk, bricks.size() - begin), 16,
      [&](std::size_t b)
      {
        const Brick& brick = bricks[begin + b];
        const std::uint64_t mask = octree.nodes()[brick.node].mask;
        for (std::uint64_t left = mask; left != 0; left &= left - 1)
        {
          const int i = lowestBit(left);
          const std::uint32_t leaf = octree.planeOf(brick.node, i);
          const MeanPlane plane = decodePlane(octree.lists()[leaf]);
          const glm::vec3 foot = MeanPlane::HalfDiagonal * plane.offset * plane.normal;
          const glm::dvec3 inVoxel(glm::clamp(foot, -0.5f, 0.5f) + 0.5f);
          visit(
            leaf, origin + h.voxelSize * (glm::dvec3(brick.firstVoxel + cellOfIndex(i)) + inVoxel));
        }
      });
    if (!progress(static_cast<double>(begin) / static_cast<double>(bricks.size())))
    {
      return false;
    }
  }
  return true;
}

void attachLeafValues(vtkPolyData* mesh, const SourceOctree& built, vtkDataArray* values)
{
  const int components = values->GetNumberOfComponents();
  const std::vector<double> means = meansOf(built.octree, built.meshLevel, values);
  const auto ofQuads = vtkSmartPointer<vtkDataArray>::Take(values->NewInstance());
  ofQuads->SetName(values->GetName());
  ofQuads->SetNumberOfComponents(components);
  ofQuads->SetNumberOfTuples(mesh->GetNumberOfCells());
  if (built.octree.header().leafGeometry == static_cast<std::uint32_t>(LeafGeometry::Voxel))
  {
    repeatForFaces(built.octree, built.meshLevel, means, ofQuads);
  }
  else
  {
    averageQuads(mesh, means, components, ofQuads);
  }
  if (components == 1)
  {
    double range[2], finite[2];
    values->GetRange(range);
    values->GetFiniteRange(finite);
    tellRange(ofQuads, range, finite);
  }
  mesh->GetFieldData()->AddArray(values);
  mesh->GetCellData()->AddArray(ofQuads);
}

LeafArrays emptyCopiesOfLeafValues(vtkPolyData* mesh)
{
  LeafArrays arrays;
  vtkFieldData* all = mesh->GetFieldData();
  for (int i = 0; i < all->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* values = leafValues(mesh, all->GetArrayName(i));
    if (values)
    {
      auto copy = vtkSmartPointer<vtkDataArray>::Take(values->NewInstance());
      copy->SetName(values->GetName());
      copy->SetNumberOfComponents(values->GetNumberOfComponents());
      copy->CopyComponentNames(values);
      arrays.emplace_back(values, copy);
    }
  }
  return arrays;
}

vtkIdType firstLeaf(const Octree& octree, const OctreeCell& cell)
{
  const Node& node = octree.nodes()[cell.node];
  const int bit = cell.firstBit + lowestBit(occupiedBelow(node, cell.firstBit, cell.above));
  return cell.node >= octree.brickBegin() ? octree.planeOf(cell.node, bit)
                                          : octree.firstPlane(child(node, bit));
}

vtkDataArray* leafValues(vtkPolyData* mesh, const char* name)
{
  vtkDataArray* values = name ? mesh->GetFieldData()->GetArray(name) : nullptr;
  // Field data of other kinds has no means in its cells.
  if (!values || values->GetNumberOfTuples() == 0 || std::string(name) == OctreeArrayName ||
    !mesh->GetCellData()->HasArray(name))
  {
    return nullptr;
  }
  Octree octree;
  std::string message;
  const bool found = openAttachedOctree(mesh, octree, message) == Attached::Found;
  return found && octree.hasPlanes() &&
      static_cast<std::uint64_t>(values->GetNumberOfTuples()) == octree.header().voxelCount
    ? values
    : nullptr;
}
}
