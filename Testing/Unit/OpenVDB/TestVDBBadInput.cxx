// Files and grids that cannot be read: one message each, nothing lost, no hang.
#include "svoVDBTest.h"

#include "vtkErrorCode.h"
#include "vtkStringArray.h"

#include <fstream>
#include <limits>
#include <sstream>

#include <openvdb/points/PointDataGrid.h>

namespace
{
using namespace svotest;
const glm::dvec3 Centre(3.3, -8.4, 40.1); // index space
}

TEST(VDBBadInput, WhatIsNoFileOfOpenVDBIsOneError)
{
  Reading none("");
  none.expectError("its name is not set");
  Reading missing("/nowhere/missing.vdb");
  EXPECT_EQ(missing.reader->GetGridNames()->GetNumberOfValues(), 0);
  missing.expectError("it cannot be opened");
  Reading asked("/nowhere/asked.vdb");
  EXPECT_EQ(asked.reader->GetNumberOfGrids(), 0);
  EXPECT_EQ(asked.reader->GetNumberOfGrids(), 0);
  EXPECT_EQ(asked.messages.errors.size(), 1u);
  EXPECT_EQ(missing.reader->CanReadFile("/nowhere/missing.vdb"), 0);
  const TemporaryFile text("text.vdb"), empty("empty.vdb"), whole("whole.vdb");
  std::ofstream(text.name()) << "this is not a file of OpenVDB, but of letters only, and of many";
  Reading letters(text.name());
  letters.expectError("cannot be read");
  EXPECT_EQ(letters.reader->CanReadFile(text.name()), 0);
  std::ofstream(empty.name()).flush();
  Reading noBytes(empty.name());
  noBytes.expectError("cannot be read");
  whole.write({});
  Reading noGrids(whole.name());
  EXPECT_EQ(noGrids.reader->CanReadFile(whole.name()), 1);
  noGrids.expectError("it has no grids");
  EXPECT_EQ(none.reader->GetErrorCode(), vtkErrorCode::NoFileNameError);
  EXPECT_EQ(missing.reader->GetErrorCode(), vtkErrorCode::FileNotFoundError);
  EXPECT_EQ(letters.reader->GetErrorCode(), vtkErrorCode::UnrecognizedFileTypeError);
  EXPECT_EQ(noBytes.reader->GetErrorCode(), vtkErrorCode::UnrecognizedFileTypeError);
  EXPECT_EQ(noGrids.reader->GetErrorCode(), vtkErrorCode::FileFormatError);
  whole.write({ sphereGrid(6.0, Centre) });
  Reading other(whole.name());
  other.reader->SetGridName("other");
  other.expectError("it has no grid \"other\"");
  EXPECT_EQ(other.reader->GetErrorCode(), vtkErrorCode::UserError);
  other.reader->SetGridName("");
  other.reader->Update();
  EXPECT_EQ(other.reader->GetErrorCode(), vtkErrorCode::NoError);
  EXPECT_GT(other.reader->GetNumberOfVoxels(), 0);
}

TEST(VDBBadInput, TruncatedFilesAreOneErrorEach)
{
  const TemporaryFile whole("whole.vdb"), cut("cut.vdb");
  whole.write({ sphereGrid(6.0, Centre), sphereGrid(4.0, Centre) });
  std::stringstream bytes;
  bytes << std::ifstream(whole.name(), std::ios::binary).rdbuf();
  const std::string all = bytes.str();
  std::size_t tried = 0, premature = 0;
  for (std::size_t size = 8; size < all.size(); size += 1 + size / 16)
  {
    std::ofstream(cut.name(), std::ios::binary | std::ios::trunc)
      .write(all.data(), static_cast<std::streamsize>(size));
    Reading reading(cut.name());
    reading.expectError("cannot be read");
    EXPECT_NE(reading.reader->GetErrorCode(), vtkErrorCode::NoError) << size;
    premature += reading.reader->GetErrorCode() == vtkErrorCode::PrematureEndOfFileError;
    ++tried;
  }
  EXPECT_GT(tried, 50u);
  EXPECT_GT(premature, tried / 2);
}

TEST(VDBBadInput, WhatHasNoSurfaceIsOneMessage)
{
  const auto expect = [](const openvdb::GridBase::Ptr& grid, const std::string& text)
  {
    const TemporaryFile file("unfit.vdb");
    file.write({ grid });
    Reading reading(file.name());
    reading.expectError(text);
  };
  openvdb::initialize();
  expect(openvdb::Vec3SGrid::create(), "grids of vec3s have no surface");
  expect(openvdb::points::PointDataGrid::create(), "have no surface");
  const auto frustum = sphereGrid(5.0, Centre);
  frustum->setTransform(openvdb::math::Transform::createFrustumTransform(
    openvdb::BBoxd(openvdb::Vec3d(0.0), openvdb::Vec3d(100.0)), 0.5, 10.0, 1.0));
  expect(frustum, "frustum");
  auto huge = openvdb::MaskGrid::create();
  huge->tree().addTile(2, openvdb::Coord(0), true, true); // 4096^3
  huge->tree().addTile(3, openvdb::Coord(8192), true, true);
  expect(huge, "more memory than the limit of");
  // Few tiles stand for many voxels: of what takes minutes it is said how much it is.
  auto tile = openvdb::FloatGrid::create(0.0f);
  tile->fill(openvdb::CoordBBox({ 0, 0, 0 }, { 1023, 1023, 1023 }), 1.0f, true);
  expect(tile,
    "1073741824 occupied voxels, those of constant tiles included, and an octree of them "
    "needs about 16.0 GiB, more memory than the limit of 4.0 GiB; MemoryLimit can allow "
    "more; as a surface it has voxels at its border only");
  auto wide = openvdb::MaskGrid::create();
  wide->tree().setValueOn({ -2000000, 0, 0 });
  wide->tree().setValueOn({ 2000000000, 0, 0 });
  expect(wide, "2^20");

  const TemporaryFile file("empty-grid.vdb");
  file.write({ openvdb::FloatGrid::create() });
  Reading reading(file.name());
  EXPECT_EQ(reading.output()->GetNumberOfCells(), 0);
  EXPECT_EQ(reading.messages.warnings.size(), 1u) << reading.messages.all();
  EXPECT_EQ(reading.messages.errors.size(), 0u) << reading.messages.all();
  EXPECT_NE(reading.messages.all().find("is empty"), std::string::npos);
}

TEST(VDBBadInput, ValuesThatAreNoneHaveNoSurface)
{
  const auto grid = sphereGrid(8.0, Centre);
  for (auto value = grid->beginValueOn(); value; ++value)
  {
    if (value.getCoord().x() > 3)
    {
      value.setValue(value.getCoord().x() % 2 ? std::numeric_limits<float>::quiet_NaN()
                                              : std::numeric_limits<float>::infinity());
    }
  }
  vtkNew<vtkPolyData> hull;
  EXPECT_EQ(convert(*grid, hull).message, "");
  const svo::Octree octree = octreeOf(hull);
  ASSERT_TRUE(octree);
  EXPECT_GT(octree.header().voxelCount, 100u);
  for (const Cell& cell : indicesOf(octree, grid->transform()))
  {
    ASSERT_LE(std::get<0>(cell), 3);
  }
}

TEST(VDBBadInput, MemoryIsLimited)
{
  const TemporaryFile file("limit.vdb");
  file.write({ sphereGrid(40.0, Centre) });
  Reading reading(file.name());
  reading.reader->SetMemoryLimit(10);
  reading.expectError("more memory than there is");
}
