// Grids to read, and what the reader makes of them.
#ifndef svoVDBTest_h
#define svoVDBTest_h

#include "svoConversion.h"
#include "svoOctreeCells.h"
#include "svoVDBFile.h"
#include "svoVDBGrids.h"
#include "svoVDBOctree.h"
#include "vtkSVOVDBReader.h"
#include "vtkSVOVDBWriter.h"
#include "vtkSparseVoxelOctree.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

namespace svotest
{
inline vtkSmartPointer<vtkPolyData> converted(vtkPolyData* mesh, int level)
{
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetInputData(mesh);
  filter->SetMaximumLevel(level);
  filter->Update();
  return filter->GetOutput();
}

/// A file of one test, which is removed at its end.
class TemporaryFile
{
public:
  explicit TemporaryFile(const std::string& name)
    : Path((std::filesystem::temp_directory_path() /
        ("vtksvo-" + std::to_string(getpid()) + "-" + name))
             .string())
  {
  }
  ~TemporaryFile() { std::filesystem::remove(this->Path); }
  TemporaryFile(const TemporaryFile&) = delete;
  void operator=(const TemporaryFile&) = delete;
  const char* name() const { return this->Path.c_str(); }

  void write(const openvdb::GridCPtrVec& grids) const
  {
    openvdb::initialize();
    openvdb::io::File(this->Path).write(grids);
  }

private:
  std::string Path;
};

/// Distances from a sphere, in index space, of a band of three voxels around it.
template <class GridT = openvdb::FloatGrid>
typename GridT::Ptr sphereGrid(double radius, const glm::dvec3& centre)
{
  using ValueT = typename GridT::ValueType;
  constexpr double Band = 3.0;
  auto grid = GridT::create(static_cast<ValueT>(Band));
  auto values = grid->getAccessor();
  const int far = static_cast<int>(radius + Band + 1.0);
  const glm::ivec3 c(glm::round(centre));
  for (int z = -far; z <= far; ++z)
  {
    for (int y = -far; y <= far; ++y)
    {
      for (int x = -far; x <= far; ++x)
      {
        const glm::ivec3 at = c + glm::ivec3(x, y, z);
        const double d = glm::length(glm::dvec3(at) - centre) - radius;
        if (std::abs(d) < Band)
        {
          values.setValue({ at.x, at.y, at.z }, static_cast<ValueT>(d));
        }
        else if (d < 0.0)
        {
          values.setValueOff({ at.x, at.y, at.z }, static_cast<ValueT>(-Band));
        }
      }
    }
  }
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->setName("sphere");
  return grid;
}

inline openvdb::math::Transform::Ptr transformOfMatrix(const glm::dmat4& m)
{
  openvdb::math::Mat4d rows;
  for (int i = 0; i < 4; ++i)
  {
    for (int j = 0; j < 4; ++j)
    {
      rows(i, j) = m[i][j];
    }
  }
  return openvdb::math::Transform::createLinearTransform(rows);
}

/// Stretched, turned, sheared; with `mirrored` also mirrored.
inline glm::dmat4 affine(bool mirrored = false)
{
  return { { mirrored ? -0.2 : 0.2, 0.05, 0.0, 0.0 }, { -0.03, 0.1, 0.02, 0.0 },
    { 0.01, -0.04, 0.3, 0.0 }, { 5.0, -7.0, 11.0, 1.0 } };
}

struct Reading
{
  vtkNew<vtkSVOVDBReader> reader;
  svo::TestMessages messages{ reader };
  explicit Reading(const char* file) { this->reader->SetFileName(file); }
  vtkPolyData* output()
  {
    this->reader->Update();
    return this->reader->GetOutput();
  }
  svo::Octree octree()
  {
    const svo::Octree opened = octreeOf(this->output());
    EXPECT_TRUE(opened) << this->messages.all();
    return opened;
  }
  void expectError(const std::string& text)
  {
    vtkPolyData* hull = this->output();
    EXPECT_EQ(hull->GetNumberOfCells(), 0);
    EXPECT_FALSE(octreeOf(hull));
    EXPECT_EQ(this->messages.errors.size(), 1u) << this->messages.all();
    EXPECT_EQ(this->messages.warnings.size(), 0u) << this->messages.all();
    EXPECT_NE(this->messages.all().find(text), std::string::npos) << this->messages.all();
  }
};

using Cell = std::tuple<int, int, int>;

inline std::vector<Cell> cellsOf(const svo::Octree& octree)
{
  std::vector<Cell> cells;
  svo::forEachCell(octree, octree.level(),
    [&](const svo::OctreeCell& c)
    {
      cells.emplace_back(c.cell.x, c.cell.y, c.cell.z);
      return true;
    });
  std::sort(cells.begin(), cells.end());
  return cells;
}

/// The centre of a voxel in the local coordinates.
inline glm::dvec3 placeOf(const svo::Octree& octree, const Cell& cell)
{
  const svo::Header& h = octree.header();
  const glm::dvec3 own = glm::dvec3(h.origin[0], h.origin[1], h.origin[2]) +
    (glm::dvec3(std::get<0>(cell), std::get<1>(cell), std::get<2>(cell)) + 0.5) * h.voxelSize;
  return glm::dvec3(octree.transform() * glm::dvec4(own, 1.0));
}

/// Voxels (i, j, k) of the grid that the octree has, by where they lie.
inline std::vector<Cell> indicesOf(
  const svo::Octree& octree, const openvdb::math::Transform& transform)
{
  std::vector<Cell> indices;
  for (const Cell& cell : cellsOf(octree))
  {
    const glm::dvec3 p = placeOf(octree, cell);
    const openvdb::Vec3d i = transform.worldToIndex({ p.x, p.y, p.z });
    EXPECT_NEAR(i.x(), std::round(i.x()), 1e-6) << "a leaf is a voxel";
    EXPECT_NEAR(i.y(), std::round(i.y()), 1e-6);
    EXPECT_NEAR(i.z(), std::round(i.z()), 1e-6);
    indices.emplace_back(static_cast<int>(std::lround(i.x())), static_cast<int>(std::lround(i.y())),
      static_cast<int>(std::lround(i.z())));
  }
  std::sort(indices.begin(), indices.end());
  return indices;
}

inline svo::SourceOctree convert(const openvdb::GridBase& grid, vtkPolyData* hull,
  double threshold = 0.0, svo::VDBConversion conversion = svo::VDBConversion::Automatic)
{
  openvdb::initialize();
  svo::VDBOptions options;
  options.threshold = threshold;
  options.conversion = conversion;
  return svo::octreeOfGrid(grid, options, hull);
}
}

#endif
