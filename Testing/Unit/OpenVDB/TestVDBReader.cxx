// Grids of all kinds to octrees: where their voxels lie, and which are occupied.
#include "svoPlane.h"
#include "svoVDBTest.h"

#include "vtkIdList.h"

#include <limits>

namespace
{
using namespace svotest;
constexpr double Radius = 20.0;
const glm::dvec3 Centre(3.3, -8.4, 40.1); // index space

/// Shoots from all sides at what a sphere in index space is in the world.
void expectSphere(vtkPolyData* hull, const glm::dmat4& world, double error)
{
  vtkNew<vtkSparseVoxelOctree> octree;
  ASSERT_TRUE(octree->Initialize(hull));
  const glm::dmat4 back = glm::inverse(world);
  double bounds[6];
  octree->GetBounds(bounds);
  for (int i = 0; i < 500; ++i)
  {
    const double z = -0.999 + i * 0.004, a = 2.4 * i, r = std::sqrt(1.0 - z * z);
    const glm::dvec3 d(r * std::cos(a), r * std::sin(a), z);
    const glm::dvec3 from(world * glm::dvec4(Centre + 3.0 * Radius * d, 1.0));
    const glm::dvec3 to(world * glm::dvec4(Centre, 1.0));
    double t, x[3];
    vtkIdType cell = 0;
    ASSERT_EQ(octree->IntersectWithLine(&from[0], &to[0], t, x, cell), 1) << i;
    EXPECT_EQ(cell, -1);
    const glm::dvec3 hit(back * glm::dvec4(x[0], x[1], x[2], 1.0));
    EXPECT_NEAR(glm::length(hit - Centre), Radius, error) << i;
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_GE(x[k], bounds[2 * k]);
      EXPECT_LE(x[k], bounds[2 * k + 1]);
    }
    const glm::dvec3 inside(world * glm::dvec4(glm::round(Centre + (Radius - 0.1) * d), 1.0));
    octree->IsOccupied(&inside[0], 20);
    EXPECT_FALSE(octree->IsOccupied(&to[0], 20));
  }
}

/// Six times the volume that quads enclose; negative where they look inwards.
double volumeOf(vtkPolyData* quads)
{
  double sum = 0.0;
  for (vtkIdType i = 0; i < quads->GetNumberOfCells(); ++i)
  {
    vtkNew<vtkIdList> ids;
    quads->GetCellPoints(i, ids);
    glm::dvec3 p[4];
    for (int k = 0; k < 4; ++k)
    {
      quads->GetPoint(ids->GetId(k), &p[k][0]);
      p[k] -= glm::dvec3(quads->GetPoint(0)[0], quads->GetPoint(0)[1], quads->GetPoint(0)[2]);
    }
    sum += glm::dot(p[0], glm::cross(p[1], p[2])) + glm::dot(p[0], glm::cross(p[2], p[3]));
  }
  return sum;
}

/// Voxels of a box that the trilinear field of all values passes: its extremes in a voxel lie among
/// the means of one, two, four and eight values there.
std::vector<Cell> passedIn(
  const openvdb::FloatGrid& grid, double value, const openvdb::CoordBBox& box)
{
  std::vector<Cell> cells;
  const auto values = grid.getConstAccessor();
  const auto wayOf = [](int i) { return glm::ivec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1); };
  for (auto at = box.begin(); at; ++at)
  {
    double low = 1e300, high = -1e300;
    bool same = true;
    for (int i = 0; i < 27 && same; ++i)
    {
      const glm::ivec3 way = wayOf(i);
      same = values.getValue((*at).offsetBy(way.x, way.y, way.z)) == values.getValue(*at);
    }
    for (int corner = 0; corner < 27 && !same; ++corner)
    {
      const glm::ivec3 way = wayOf(corner);
      double sum = 0.0;
      for (int i = 0; i < 8; ++i)
      {
        const glm::ivec3 step = way * glm::ivec3(i & 1, i >> 1 & 1, i >> 2);
        sum += static_cast<double>(values.getValue((*at).offsetBy(step.x, step.y, step.z))) - value;
      }
      low = std::min(low, sum / 8.0);
      high = std::max(high, sum / 8.0);
    }
    if (low <= 0.0 && high >= 0.0 && low < high)
    {
      cells.emplace_back((*at).x(), (*at).y(), (*at).z());
    }
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

/// How many of 300 rays from all sides to a point inside meet a surface.
int raysThatHit(vtkPolyData* hull, const glm::dvec3& inside)
{
  vtkNew<vtkSparseVoxelOctree> octree;
  EXPECT_TRUE(octree->Initialize(hull));
  int hits = 0;
  for (int i = 0; i < 300; ++i)
  {
    const double z = -0.997 + i * 0.00665, a = 2.4 * i, r = std::sqrt(1.0 - z * z);
    const glm::dvec3 from = inside + 200.0 * glm::dvec3(r * std::cos(a), r * std::sin(a), z);
    double t, x[3];
    vtkIdType cell = 0;
    hits += octree->IntersectWithLine(&from[0], &inside[0], t, x, cell);
  }
  return hits;
}

template <class GridT>
std::vector<Cell> activeAbove(const GridT& grid, double threshold)
{
  std::vector<Cell> cells;
  for (auto value = grid.cbeginValueOn(); value; ++value)
  {
    const openvdb::CoordBBox box = value.getBoundingBox();
    for (auto at = box.begin(); at && static_cast<double>(*value) > threshold; ++at)
    {
      cells.emplace_back((*at).x(), (*at).y(), (*at).z());
    }
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

}

TEST(VDBReader, LevelSetsStandWhereTheirMapPutsThem)
{
  glm::dmat4 uniform(0.25);
  uniform[3] = { 100.0, -50.0, 3.0, 1.0 };
  glm::dmat4 mirroredAxis(0.25);
  mirroredAxis[0][0] = -0.25;
  mirroredAxis[3] = { 1.0, 2.0, 3.0, 1.0 };
  int framed = 0;
  for (const glm::dmat4& world : { glm::dmat4(1.0), uniform, mirroredAxis, affine(), affine(true) })
  {
    const TemporaryFile file("sphere.vdb");
    const auto grid = sphereGrid(Radius, Centre);
    grid->setTransform(transformOfMatrix(world));
    file.write({ grid });
    Reading reading(file.name());
    const svo::Octree octree = reading.octree();
    EXPECT_EQ(reading.messages.all(), "");
    EXPECT_EQ(octree.header().leafGeometry, std::uint32_t(svo::LeafGeometry::Plane));
    framed += octree.hasTransform();
    expectSphere(reading.output(), world, 0.02);
    for (const auto& [x, y, z] : indicesOf(octree, grid->transform()))
    {
      ASSERT_LT(std::abs(glm::length(glm::dvec3(x, y, z) - Centre) - Radius), 0.87);
    }
    // The hull looks outwards, mirrored or not: its volume is not negative.
    EXPECT_GT(volumeOf(reading.output()), 0.0);
  }
  EXPECT_EQ(framed, 3);
}

TEST(VDBReader, PlanesAreThoseOfTheField)
{
  const auto grid = sphereGrid(Radius, Centre);
  vtkNew<vtkPolyData> hull;
  convert(*grid, hull);
  const svo::Octree octree = octreeOf(hull);
  ASSERT_TRUE(octree);
  const std::vector<Cell> cells = indicesOf(octree, grid->transform());
  // No voxel that the sphere passes is missed: those with corners on both sides.
  std::size_t passed = 0;
  for (auto value = grid->cbeginValueOn(); value; ++value)
  {
    const openvdb::Coord at = value.getCoord();
    int inside = 0;
    for (int i = 0; i < 8; ++i)
    {
      const glm::dvec3 corner =
        glm::dvec3(at.x(), at.y(), at.z()) + glm::dvec3(i & 1, i >> 1 & 1, i >> 2) - 0.5;
      inside += glm::length(corner - Centre) < Radius - 0.01;
      inside += glm::length(corner - Centre) < Radius + 0.01;
    }
    if (inside > 1 && inside < 15)
    {
      ++passed;
      ASSERT_TRUE(std::binary_search(cells.begin(), cells.end(), Cell(at.x(), at.y(), at.z())));
    }
  }
  EXPECT_GT(passed, 0.9 * cells.size());
  constexpr double Bend = 0.5 / Radius; // of the sphere in a voxel: of second order
  svo::forEachCell(octree, octree.level(),
    [&](const svo::OctreeCell& c)
    {
      const svo::MeanPlane plane =
        svo::decodePlane(octree.lists()[octree.planeOf(c.node, c.firstBit)]);
      const glm::dvec3 centre = placeOf(octree, { c.cell.x, c.cell.y, c.cell.z });
      const glm::dvec3 out = glm::normalize(centre - Centre);
      EXPECT_GT(glm::dot(out, glm::dvec3(plane.normal)), 0.999);
      EXPECT_NEAR(glm::length(centre - Centre) + 0.8660254 * plane.offset, Radius, Bend);
      return true;
    });
}

TEST(VDBReader, FogIsOccupiedAboveTheThreshold)
{
  for (const glm::dmat4& world : { glm::dmat4(1.0), affine() })
  {
    auto grid = openvdb::FloatGrid::create(0.0f);
    auto values = grid->getAccessor();
    for (int i = 0; i < 20 * 20 * 20; ++i)
    {
      const openvdb::Coord at(i % 20 - 13, i / 20 % 20, i / 400 + 3);
      values.setValue(at, 0.01f * static_cast<float>((i * 37) % 101));
    }
    values.setValue({ 100, 3, -70 }, 0.7f);
    values.setValue({ 101, 3, -70 }, std::numeric_limits<float>::quiet_NaN());
    values.setValueOff({ 102, 3, -70 }, 5.0f);
    grid->setTransform(transformOfMatrix(world));
    const TemporaryFile file("fog.vdb");
    file.write({ grid });
    for (const double threshold : { 0.0, 0.5, 0.995 })
    {
      Reading reading(file.name());
      reading.reader->SetThreshold(threshold);
      const svo::Octree octree = reading.octree();
      EXPECT_EQ(octree.header().leafGeometry, std::uint32_t(svo::LeafGeometry::Voxel));
      EXPECT_EQ(indicesOf(octree, grid->transform()), activeAbove(*grid, threshold));
      EXPECT_EQ(
        reading.reader->GetNumberOfVoxels(), static_cast<vtkIdType>(octree.header().voxelCount));
    }
    Reading nothing(file.name());
    nothing.reader->SetThreshold(5.0);
    EXPECT_EQ(nothing.output()->GetNumberOfCells(), 0);
    EXPECT_EQ(nothing.messages.warnings.size(), 1u);
    EXPECT_EQ(nothing.messages.errors.size(), 0u) << nothing.messages.all();
  }
}

TEST(VDBReader, TilesAreTheVoxelsThatTheyStandFor)
{
  auto grid = openvdb::BoolGrid::create(false);
  grid->fill(openvdb::CoordBBox({ -5, 0, 3 }, { 300, 20, 150 }), true, true);
  grid->tree().prune();
  grid->tree().setValueOff({ 130, 10, 60 });
  ASSERT_GT(grid->tree().activeTileCount(), 0u);
  vtkNew<vtkPolyData> hull;
  EXPECT_EQ(convert(*grid, hull).message, "");
  const svo::Octree octree = octreeOf(hull);
  ASSERT_TRUE(octree);
  EXPECT_EQ(octree.level(), 9);
  EXPECT_EQ(octree.header().voxelCount, 306u * 21u * 148u - 1u);
  EXPECT_EQ(indicesOf(octree, grid->transform()), activeAbove(*grid, 0.5));
}

TEST(VDBReader, AllKindsOfNumbers)
{
  const auto sphere = sphereGrid(8.0, Centre);
  const auto doubles = sphereGrid<openvdb::DoubleGrid>(8.0, Centre);
  vtkNew<vtkPolyData> hull;
  convert(*sphere, hull);
  const std::vector<Cell> expected = indicesOf(octreeOf(hull), sphere->transform());
  convert(*doubles, hull);
  EXPECT_EQ(indicesOf(octreeOf(hull), sphere->transform()), expected);

  const TemporaryFile file("half.vdb");
  const auto half = sphere->deepCopy();
  half->setSaveFloatAsHalf(true);
  file.write({ half });
  Reading reading(file.name());
  EXPECT_NEAR(static_cast<double>(cellsOf(reading.octree()).size()),
    static_cast<double>(expected.size()), 0.02 * static_cast<double>(expected.size()));

  const openvdb::MaskGrid::Ptr mask = openvdb::MaskGrid::create();
  mask->topologyUnion(*sphere);
  convert(*mask, hull);
  EXPECT_EQ(indicesOf(octreeOf(hull), sphere->transform()), activeAbove(*mask, 0.5));

  auto ints = openvdb::Int32Grid::create(0);
  auto longs = openvdb::Int64Grid::create(0);
  for (int i = 0; i < 50; ++i)
  {
    ints->getAccessor().setValue({ i, 2 * i, -i }, i);
    longs->getAccessor().setValue({ i, 2 * i, -i }, i);
  }
  convert(*ints, hull, 25.0);
  EXPECT_EQ(octreeOf(hull).header().voxelCount, 24u);
  convert(*longs, hull, 25.0);
  EXPECT_EQ(octreeOf(hull).header().voxelCount, 24u);
}

TEST(VDBReader, ConversionOnRequest)
{
  // Fog that falls from the middle is a surface where it takes the threshold, and looks outwards.
  const auto fog = sphereGrid(10.0, Centre);
  for (auto value = fog->beginValueAll(); value; ++value)
  {
    value.setValue(-*value);
  }
  fog->setGridClass(openvdb::GRID_FOG_VOLUME);
  vtkNew<vtkPolyData> hull;
  convert(*fog, hull, 1.0, svo::VDBConversion::Surface);
  const svo::Octree octree = octreeOf(hull);
  ASSERT_TRUE(octree);
  for (const Cell& cell : cellsOf(octree))
  {
    ASSERT_LT(std::abs(glm::length(placeOf(octree, cell) - Centre) - 9.0), 0.8661 + 0.5 / 9.0);
  }
  svo::forEachCell(octree, octree.level(),
    [&](const svo::OctreeCell& c)
    {
      const svo::MeanPlane plane =
        svo::decodePlane(octree.lists()[octree.planeOf(c.node, c.firstBit)]);
      const glm::dvec3 out = placeOf(octree, { c.cell.x, c.cell.y, c.cell.z }) - Centre;
      EXPECT_GT(glm::dot(out, glm::dvec3(plane.normal)), 0.0);
      return true;
    });
  const auto level = sphereGrid(10.0, Centre);
  convert(*level, hull, -100.0, svo::VDBConversion::Voxels);
  EXPECT_EQ(indicesOf(octreeOf(hull), level->transform()), activeAbove(*level, -100.0));
}

TEST(VDBReader, SurfacesAreThoseOfTheWholeField)
{
  // Active voxels in inactive ones; tiles of all sizes; tiles beside each other; values that are
  // not active; a background on the surface.
  std::vector<openvdb::FloatGrid::Ptr> grids;
  for (int i = 0; i < 6; ++i)
  {
    grids.push_back(openvdb::FloatGrid::create(0.0f));
  }
  const openvdb::CoordBBox box({ -20, -20, -20 }, { 27, 27, 27 });
  for (auto at = box.begin(); at; ++at)
  {
    const double r = glm::length(glm::dvec3((*at).x(), (*at).y(), (*at).z()) - 3.5);
    if (r < 17.0)
    {
      grids[0]->tree().setValueOn(*at, 1.0f);
      grids[1]->tree().setValueOff(*at, 1.0f);
    }
    if (r < 19.0)
    {
      grids[5]->tree().setValueOn(*at, static_cast<float>(1.0 - r / 20.0));
    }
  }
  grids[2]->fill(openvdb::CoordBBox({ -8, -8, -8 }, { 15, 15, 15 }), 1.0f, true);
  grids[3]->fill(openvdb::CoordBBox({ 0, 0, 0 }, { 7, 7, 7 }), 1.0f, true);
  grids[3]->fill(openvdb::CoordBBox({ 8, 0, 0 }, { 15, 7, 7 }), 0.6f, true);
  grids[4]->fill(openvdb::CoordBBox({ -5, 0, 2 }, { 140, 20, 12 }), 1.0f, true);
  for (const auto& grid : grids)
  {
    const openvdb::CoordBBox all = grid == grids[4]
      ? openvdb::CoordBBox({ -12, -12, -12 }, { 150, 30, 30 })
      : openvdb::CoordBBox({ -30, -30, -30 }, { 37, 37, 37 });
    for (const double value : { 0.0, 0.1, 0.51, 0.9 })
    {
      SCOPED_TRACE(testing::Message() << grid->activeVoxelCount() << " active, " << value);
      vtkNew<vtkPolyData> hull;
      EXPECT_EQ(convert(*grid, hull, value, svo::VDBConversion::Surface).message, "");
      EXPECT_EQ(indicesOf(octreeOf(hull), grid->transform()), passedIn(*grid, value, all));
      if (grid == grids[0] || grid == grids[2]) // a ball and a cube around that point
      {
        EXPECT_EQ(raysThatHit(hull, glm::dvec3(3.5, 3.5, 3.5)), 300);
      }
    }
  }
  // A tile of 128^3 is known by its borders.
  auto large = openvdb::FloatGrid::create(0.0f);
  large->tree().addTile(2, openvdb::Coord(0), 1.0f, true);
  vtkNew<vtkPolyData> hull;
  convert(*large, hull, 0.25, svo::VDBConversion::Surface);
  ASSERT_TRUE(octreeOf(hull));
  EXPECT_EQ(raysThatHit(hull, glm::dvec3(60.0)), 300);
  const std::vector<Cell> cells = indicesOf(octreeOf(hull), large->transform());
  EXPECT_GT(cells.size(), 6u * 128u * 128u);
  for (const auto& [x, y, z] : cells)
  {
    const glm::ivec3 out = glm::abs(2 * glm::ivec3(x, y, z) - 127);
    ASSERT_GE(std::max({ out.x, out.y, out.z }), 127);
    ASSERT_LE(std::max({ out.x, out.y, out.z }), 129);
  }
}

TEST(VDBReader, ThreadsChangeNothing)
{
  const auto grid = sphereGrid(30.0, Centre);
  openvdb::initialize();
  vtkNew<vtkPolyData> serial, parallel;
  svo::VDBOptions options;
  svo::octreeOfGrid(*grid, options, serial);
  options.parallelFor = svo::smpParallelFor();
  svo::octreeOfGrid(*grid, options, parallel);
  const svo::Octree a = octreeOf(serial), b = octreeOf(parallel);
  ASSERT_TRUE(a && b);
  const std::size_t size = svo::bufferSize(a.header());
  ASSERT_EQ(size, svo::bufferSize(b.header()));
  EXPECT_EQ(std::memcmp(a.key(), b.key(), size), 0);
}

TEST(VDBReader, AThresholdIsANumber)
{
  vtkNew<vtkSVOVDBReader> reader;
  svo::TestMessages messages(reader);
  reader->SetThreshold(0.25);
  const vtkMTimeType time = reader->GetMTime();
  reader->SetThreshold(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(reader->GetThreshold(), 0.25);
  EXPECT_EQ(reader->GetMTime(), time);
  EXPECT_EQ(messages.errors.size(), 1u) << messages.all();
}
