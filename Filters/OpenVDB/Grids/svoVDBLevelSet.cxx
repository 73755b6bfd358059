#include "svoVDBLevelSet.h"

#include "svoCellSurface.h"
#include "svoMeshTriangles.h"
#include "svoNearTriangles.h"
#include "svoOctree.h"
#include "svoOctreeCells.h"
#include "svoPlane.h"
#include "svoVDBLeaves.h"
#include "svoVDBTransform.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

#include <glm/common.hpp>
#include <openvdb/math/Proximity.h>
#include <openvdb/tools/ChangeBackground.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/Prune.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace svo
{
namespace
{
using openvdb::Vec3d;

/// Triangles and quads in the grid's index space, as OpenVDB's conversion asks for them.
struct Polygons
{
  std::vector<Vec3d> points;
  std::vector<std::array<std::uint32_t, 4>> corners; // of a triangle the last two are the same
  std::vector<std::uint32_t> ofTriangle;             // of the octree's, where it has any

  std::size_t polygonCount() const { return corners.size(); }
  std::size_t pointCount() const { return points.size(); }
  std::size_t vertexCount(std::size_t n) const { return corners[n][2] == corners[n][3] ? 3 : 4; }
  void getIndexSpacePoint(std::size_t n, std::size_t v, Vec3d& at) const
  {
    at = points[corners[n][v]];
  }
  /// Of a point from a triangle; the bound, if that is less.
  double distance(std::size_t n, const glm::dvec3& p, double bound) const
  {
    const auto& c = corners[n];
    double square = 0.0; // of the distance from the triangle's box
    for (int i = 0; i < 3; ++i)
    {
      const double x = points[c[0]][i], y = points[c[1]][i], z = points[c[2]][i];
      const double away =
        std::max({ std::min({ x, y, z }) - p[i], p[i] - std::max({ x, y, z }), 0.0 });
      square += away * away;
    }
    if (square >= bound * bound)
    {
      return bound;
    }
    openvdb::Vec3d weights;
    const openvdb::Vec3d at(p.x, p.y, p.z);
    return (openvdb::math::closestPointOnTriangleToPoint(
              points[c[0]], points[c[1]], points[c[2]], at, weights) -
      at)
      .length();
  }
};

/// Points that belong to one polygon of 3 to 6 corners.
void addPolygon(const std::vector<glm::dvec3>& ring, Polygons& to)
{
  const auto first = static_cast<std::uint32_t>(to.points.size());
  for (const glm::dvec3& p : ring)
  {
    to.points.emplace_back(p.x, p.y, p.z);
  }
  for (std::uint32_t i = 2; i < ring.size(); ++i)
  {
    to.corners.push_back({ first, first + i - 1, first + i, first + i });
  }
}

/// The mesh's triangles, but for those that the octree left out, with points that are not finite.
void addTriangles(const Octree& octree, vtkPolyData* mesh, Polygons& to)
{
  const MeshTriangles triangles(mesh);
  const TriangleMesh view = triangles.view();
  const Header& h = octree.header();
  const glm::dvec3 origin(h.origin[0], h.origin[1], h.origin[2]);
  std::vector<char> finite(view.pointCount);
  to.points.reserve(view.pointCount);
  for (std::size_t i = 0; i < view.pointCount; ++i)
  {
    const glm::dvec3 p = (view.points[i] - origin) / h.voxelSize - 0.5;
    finite[i] = std::isfinite(p.x + p.y + p.z);
    to.points.emplace_back(p.x, p.y, p.z);
  }
  to.corners.reserve(view.triangleCount);
  for (std::size_t i = 0; i < view.triangleCount; ++i)
  {
    const glm::uvec3& t = view.triangles[i];
    to.ofTriangle.push_back(static_cast<std::uint32_t>(to.corners.size()));
    if (finite[t.x] && finite[t.y] && finite[t.z])
    {
      to.corners.push_back({ t.x, t.y, t.z, t.z });
    }
  }
}

/// What of a plane lies in the cube of edge 1 around a centre; fewer than 3 points if nothing does.
void cutCube(
  const glm::dvec3& centre, const glm::dvec3& normal, double offset, std::vector<glm::dvec3>& ring)
{
  const glm::dvec3 along = glm::abs(normal);
  const int axis = along.x >= along.y && along.x >= along.z ? 0 : along.y >= along.z ? 1 : 2;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  constexpr double Corners[4][2] = { { -0.5, -0.5 }, { 0.5, -0.5 }, { 0.5, 0.5 }, { -0.5, 0.5 } };
  std::vector<glm::dvec3> whole;
  for (const auto& c : Corners)
  {
    glm::dvec3 p;
    p[u] = c[0];
    p[v] = c[1];
    p[axis] = (offset - normal[u] * c[0] - normal[v] * c[1]) / normal[axis];
    whole.push_back(p);
  }
  // Sutherland and Hodgman at the two faces across the axis.
  for (const double side : { -1.0, 1.0 })
  {
    ring.clear();
    for (std::size_t i = 0; i < whole.size(); ++i)
    {
      const glm::dvec3& a = whole[i];
      const glm::dvec3& b = whole[(i + 1) % whole.size()];
      const double inA = 0.5 - side * a[axis], inB = 0.5 - side * b[axis];
      if (inA >= 0.0)
      {
        ring.push_back(a);
      }
      if ((inA > 0.0 && inB < 0.0) || (inA < 0.0 && inB > 0.0))
      {
        ring.push_back(a + inA / (inA - inB) * (b - a));
      }
    }
    whole = ring;
  }
  for (glm::dvec3& p : ring)
  {
    p += centre;
  }
}

void addPlanes(const Octree& octree, Polygons& to)
{
  std::vector<glm::dvec3> ring;
  forEachCell(octree, octree.level(),
    [&](const OctreeCell& cell)
    {
      const MeanPlane plane = decodePlane(octree.lists()[octree.planeOf(cell.node, cell.firstBit)]);
      // Half diagonals of the voxel; index space has its centre where the voxel's numbers are.
      const double offset = 0.5 * std::sqrt(3.0) * static_cast<double>(plane.offset);
      cutCube(glm::dvec3(cell.cell), glm::dvec3(plane.normal), offset, ring);
      if (ring.size() >= 3)
      {
        addPolygon(ring, to);
      }
      return true;
    });
}

void addFaces(const Octree& octree, Polygons& to)
{
  std::vector<glm::dvec3> ring(4);
  forEachVisibleCell(octree, octree.level(), false,
    [&](const OctreeCell& cell, int faces)
    {
      for (int f = 0; f < CellFaces; ++f)
      {
        for (int i = 0; i < 4 && (faces >> f & 1); ++i)
        {
          ring[static_cast<std::size_t>(i)] =
            glm::dvec3(cell.cell + FacesOfCell[f].corners[i]) - 0.5;
        }
        if (faces >> f & 1)
        {
          addPolygon(ring, to);
        }
      }
      return true;
    });
}

/// Hands OpenVDB's progress on, on the thread that asked for the conversion only.
class Interrupter : public openvdb::util::NullInterrupter
{
public:
  explicit Interrupter(const std::function<bool(double)>& progress)
    : Progress(progress)
    , Caller(std::this_thread::get_id())
  {
  }
  bool wasInterrupted(int percent = -1) override
  {
    if (percent >= 0 && this->Progress && std::this_thread::get_id() == this->Caller &&
      !this->Stopped)
    {
      this->Stopped = !this->Progress(0.01 * percent);
    }
    return this->Stopped;
  }

private:
  const std::function<bool(double)>& Progress;
  const std::thread::id Caller;
  std::atomic<bool> Stopped{ false };
};

/// Makes distances exact, of which OpenVDB knows an upper bound from the triangles of neighbours,
/// and ends the band where they say so.
void measure(const Octree& octree, const Polygons& polygons, float halfWidth, double voxel,
  openvdb::FloatGrid& grid)
{
  using LeafT = openvdb::FloatTree::LeafNodeType;
  std::vector<LeafT*> leaves;
  grid.tree().getNodes(leaves);
  const auto end = static_cast<float>(halfWidth * voxel);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, leaves.size()),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t i = range.begin(); i < range.end(); ++i)
      {
        LeafT& leaf = *leaves[i];
        const openvdb::Coord& corner = leaf.origin();
        NearTriangles near(octree, { corner.x(), corner.y(), corner.z() }, halfWidth + 1.0);
        for (auto value = leaf.beginValueOn(); value; ++value)
        {
          const openvdb::Coord at = value.getCoord();
          const double exact =
            near.distance({ at.x(), at.y(), at.z() }, std::abs(static_cast<double>(*value)) / voxel,
              [&](std::uint32_t triangle, const glm::dvec3& p, double bound)
              { return polygons.distance(polygons.ofTriangle[triangle], p, bound); });
          const auto distance = static_cast<float>(exact * voxel);
          if (distance < end)
          {
            value.setValue(*value < 0.0f ? -distance : distance);
          }
          else
          {
            value.setValue(*value < 0.0f ? -end : end);
            value.setValueOff();
          }
        }
      }
    });
  openvdb::tools::changeLevelSetBackground(grid.tree(), end);
  openvdb::tools::pruneLevelSet(grid.tree());
}

bool anyInside(const openvdb::FloatGrid& grid)
{
  for (auto value = grid.cbeginValueAll(); value; ++value)
  {
    if (*value < 0.0f)
    {
      return true;
    }
  }
  return false;
}
}

openvdb::FloatGrid::Ptr levelSetOf(const Octree& octree, vtkPolyData* mesh, double halfWidth,
  const std::function<bool(double)>& progress, std::string& message)
{
  message.clear();
  if (!keepsAngles(octree.transform()))
  {
    message = "a level set needs voxels that are cubes, and the octree's are stretched or sheared";
    return nullptr;
  }
  Polygons polygons;
  if (!octree.hasPlanes())
  {
    addTriangles(octree, mesh, polygons);
  }
  else if (octree.header().leafGeometry == static_cast<std::uint32_t>(LeafGeometry::Voxel))
  {
    addFaces(octree, polygons);
  }
  else
  {
    addPlanes(octree, polygons);
  }
  // Renormalised, distances would be smoother than the mesh is.
  constexpr int flags = openvdb::tools::DISABLE_RENORMALIZATION;
  Interrupter interrupter(progress);
  const auto band = static_cast<float>(std::max(halfWidth, 1.0));
  const openvdb::math::Transform::Ptr place = transformOf(octree);
  const openvdb::math::Transform& transform = *place;
  // A voxel more, since OpenVDB takes some distances for larger than they are.
  const bool measured = octree.surface() != nullptr && !octree.empty();
  openvdb::FloatGrid::Ptr grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(interrupter,
    polygons, transform, measured ? band + 1.0f : band, measured ? band + 1.0f : band, flags);
  if (interrupter.wasInterrupted() || !grid)
  {
    return nullptr;
  }
  if (measured)
  {
    measure(octree, polygons, band, transform.voxelSize()[0], *grid);
  }
  grid->setName(LevelSetName);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  describe(octree, *grid);
  if (!octree.empty() && !anyInside(*grid))
  {
    message = "the surface encloses nothing, so that no distance in the level set is negative";
  }
  return grid;
}
}
