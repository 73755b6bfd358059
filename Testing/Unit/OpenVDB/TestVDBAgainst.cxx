// Against OpenVDB's own answers: which voxels a mesh has, and where rays meet a level set.
#include "svoIntersect.h"
#include "svoLattice.h"
#include "svoMeshTriangles.h"
#include "svoSeparatingAxes.h"
#include "svoVDBLevelSet.h"
#include "svoVDBOctree.h"
#include "svoVDBTest.h"
#include "vtkPolyDataToSVO.h"

#include "vtkPoints.h"

#include <cstdio>
#include <map>
#include <random>

#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/RayIntersector.h>

namespace
{
using namespace svotest;

/// A closed surface with waves and narrow places.
vtkSmartPointer<vtkPolyData> waves(int resolution)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(2 * resolution);
  source->SetPhiResolution(resolution);
  source->SetRadius(1.0);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  vtkPoints* points = source->GetOutput()->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double x[3];
    points->GetPoint(i, x);
    const double f =
      1.0 + 0.3 * std::sin(7.0 * x[2] + 1.0) * std::cos(5.0 * x[0]) * std::cos(3.0 * x[1]);
    points->SetPoint(i, f * x[0], 0.7 * f * x[1], 1.2 * f * x[2]);
  }
  return source->GetOutput();
}

/// Whether a triangle touches a voxel, told apart by exact integers: the builder's definition, by
/// another way (svoSeparatingAxes.h).
class Touches
{
public:
  Touches(const svo::Octree& octree, const svo::TriangleMesh& mesh)
    : Place(cubeOf(octree), octree.level())
  {
    for (std::size_t i = 0; i < mesh.triangleCount; ++i)
    {
      Corners c;
      for (int k = 0; k < 3; ++k)
      {
        c.at[k] = this->Place.snap(this->Place.place(mesh.points[mesh.triangles[i][k]]));
      }
      const glm::ivec3 low =
        (glm::min(glm::min(c.at[0], c.at[1]), c.at[2]) - 1) >> svo::LatticeBits;
      const glm::ivec3 high =
        (glm::max(glm::max(c.at[0], c.at[1]), c.at[2]) + 1) >> svo::LatticeBits;
      for (int z = low.z; z <= high.z; ++z)
      {
        for (int y = low.y; y <= high.y; ++y)
        {
          for (int x = low.x; x <= high.x; ++x)
          {
            this->Near[{ x, y, z }].push_back(static_cast<int>(this->Triangles.size()));
          }
        }
      }
      this->Triangles.push_back(c);
    }
  }
  bool operator()(const Cell& cell) const
  {
    const auto found = this->Near.find(cell);
    const glm::ivec3 low =
      svo::LatticeUnits * glm::ivec3(std::get<0>(cell), std::get<1>(cell), std::get<2>(cell));
    return found != this->Near.end() &&
      std::any_of(found->second.begin(), found->second.end(),
        [&](int i)
        {
          return overlapBySeparatingAxes(
            this->Triangles[static_cast<std::size_t>(i)].at, low - 1, low + svo::LatticeUnits + 1);
        });
  }

private:
  struct Corners
  {
    glm::ivec3 at[3];
  };
  static svo::Cube cubeOf(const svo::Octree& octree)
  {
    const svo::Header& h = octree.header();
    return { { h.origin[0], h.origin[1], h.origin[2] }, std::ldexp(h.voxelSize, octree.level()) };
  }
  svo::Lattice Place;
  std::vector<Corners> Triangles;
  std::map<Cell, std::vector<int>> Near;
};
}

// A voxel of ours is one that a triangle touches. OpenVDB's are those whose centres are near: what
// is nearer than half of an edge touches for certain, what is further than half of a diagonal (of
// the grown voxel) does not, and between them exact integers decide.
TEST(VDBAgainst, VoxelsOfAMeshAreThoseOfItsDistances)
{
  const auto mesh = waves(60);
  for (int level = 6; level <= 9; ++level)
  {
    const auto output = converted(mesh, level);
    const svo::Octree octree = octreeOf(output);
    const double voxel = octree.header().voxelSize;
    std::string message;
    const auto grid = svo::levelSetOf(octree, output, 1.5, nullptr, message);
    ASSERT_TRUE(grid);
    const svo::MeshTriangles triangles(mesh);
    const Touches touches(octree, triangles.view());
    std::size_t near = 0, between = 0, betweenOurs = 0, far = 0, ours = 0;
    const double grown = 0.5 + 1.5 / svo::LatticeUnits, rounding = 1e-4;
    for (auto value = grid->cbeginValueOn(); value; ++value)
    {
      const openvdb::Coord at = value.getCoord();
      const bool own = octree.occupied({ at.x(), at.y(), at.z() }, level);
      const double distance = std::abs(static_cast<double>(*value)) / voxel;
      ours += own;
      if (distance < 0.5 - rounding)
      {
        ++near;
        ASSERT_TRUE(own) << level << " " << at;
      }
      else if (distance > std::sqrt(3.0) * grown + rounding)
      {
        ++far;
        ASSERT_FALSE(own) << level << " " << at;
      }
      else
      {
        ++between;
        betweenOurs += own;
        ASSERT_EQ(own, touches({ at.x(), at.y(), at.z() })) << level << " " << at << distance;
      }
    }
    // None of ours is beyond their band.
    EXPECT_EQ(ours, octree.header().voxelCount);
    EXPECT_GT(betweenOurs, 0u);
    EXPECT_LT(betweenOurs, between);
    std::printf(
      "level %d: %zu voxels of ours; of OpenVDB's band (%zu) %zu are nearer than half an "
      "edge, all ours; %zu touch or not, and %zu of them do; %zu are too far, none ours\n",
      level, ours, near + between + far, near, between, betweenOurs, far);
  }
}

// A million rays, from all sides at all of the box.
TEST(VDBAgainst, RaysMeetALevelSetWhereOpenVDBsDo)
{
  openvdb::initialize();
  const auto mesh = converted(waves(200), 8);
  std::string message;
  const auto grid = svo::levelSetOf(octreeOf(mesh), mesh, 3.0, nullptr, message);
  ASSERT_TRUE(grid);
  vtkNew<vtkPolyData> hull;
  svo::octreeOfGrid(*grid, svo::VDBOptions(), hull);
  const svo::Octree octree = octreeOf(hull);
  ASSERT_TRUE(octree && !octree.hasTransform());
  const double voxel = octree.header().voxelSize;
  openvdb::tools::LevelSetRayIntersector<openvdb::FloatGrid> theirs(*grid);
  openvdb::tools::GridSampler<openvdb::FloatGrid, openvdb::tools::BoxSampler> field(*grid);

  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const auto direction = [&]
  {
    glm::dvec3 d;
    do
    {
      d = { any(random), any(random), any(random) };
    } while (glm::dot(d, d) > 1.0 || glm::dot(d, d) < 0.01);
    return glm::normalize(d);
  };
  constexpr int Rays = 1000000;
  const glm::dmat4 toOctree = octree.localToOctree();
  std::size_t both = 0, none = 0, within = 0, grazing = 0, onlyOurs = 0, onlyTheirs = 0;
  for (int i = 0; i < Rays; ++i)
  {
    const glm::dvec3 from = 4.0 * direction();
    const glm::dvec3 to(1.3 * any(random), any(random), 1.5 * any(random));
    const glm::dvec3 along = glm::normalize(to - from);
    const openvdb::math::Ray<double> ray(
      openvdb::Vec3d(from.x, from.y, from.z), openvdb::Vec3d(along.x, along.y, along.z));
    openvdb::Vec3d point(0.0);
    const bool hitTheirs = theirs.intersectsWS(ray, point);
    svo::Ray own;
    own.origin = glm::dvec3(toOctree * glm::dvec4(from, 1.0));
    own.direction = glm::dvec3(toOctree * glm::dvec4(along, 0.0));
    own.tMin = 0.0;
    own.tMax = 20.0;
    const svo::Hit hit = svo::intersect(octree, own, { svo::LeafGeometry::Plane });
    both += hit && hitTheirs;
    none += !hit && !hitTheirs;
    if (hit)
    {
      const glm::dvec3 at = from + hit.t * along;
      ASSERT_LT(std::abs(field.wsSample({ at.x, at.y, at.z })), voxel) << "on the surface";
    }
    if (hit && hitTheirs)
    {
      const glm::dvec3 at(point.x(), point.y(), point.z());
      const double apart = std::abs(glm::dot(at - from, along) - hit.t);
      within += apart <= voxel;
      // Rays that pass the surface closely: one meets a ridge that the other passes by.
      grazing += apart > voxel;
    }
    onlyOurs += hit && !hitTheirs;
    onlyTheirs += !hit && hitTheirs;
  }
  std::printf(
    "%d rays: %zu hit for both, %zu for none; %zu within a voxel, %zu grazing and further "
    "apart; %zu hit for us only, %zu for OpenVDB only\n",
    Rays, both, none, within, grazing, onlyOurs, onlyTheirs);
  EXPECT_GT(both, Rays / 4u);
  EXPECT_GT(none, Rays / 20u);
  EXPECT_LT(grazing + onlyOurs + onlyTheirs, Rays / 500u);
}
