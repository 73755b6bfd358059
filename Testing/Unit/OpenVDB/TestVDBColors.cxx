// Another grid of the file colours an octree.
#include "svoLeafValues.h"
#include "svoVDBTest.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"

using namespace svotest;

// Of a linear field the trilinear values are the field's own, wherever the grids lie.
TEST(VDBColors, AreTrilinearValuesOfAnotherGrid)
{
  for (const auto conversion : { vtkSVOVDBReader::AUTOMATIC, vtkSVOVDBReader::VOXELS })
  {
    const TemporaryFile file("colors.vdb");
    const auto sphere = sphereGrid(12.0, glm::dvec3(1.3, -2.1, 4.6));
    sphere->setTransform(transformOfMatrix(affine(true)));
    const glm::dvec3 slope(2.0, -3.0, 5.0);
    const auto field = [&](const openvdb::Vec3d& p)
    { return 7.0 + slope.x * p.x() + slope.y * p.y() + slope.z * p.z(); };
    const auto heat = openvdb::DoubleGrid::create(0.0);
    const auto velocity = openvdb::Vec3SGrid::create();
    heat->setName("heat");
    velocity->setName("velocity");
    heat->setTransform(openvdb::math::Transform::createLinearTransform(0.31));
    velocity->setTransform(sphere->transform().copy());
    const openvdb::CoordBBox around = sphere->evalActiveVoxelBoundingBox();
    openvdb::BBoxd bounds;
    for (int i = 0; i < 8; ++i)
    {
      const auto corner = [&](int a)
      { return i >> a & 1 ? around.max()[a] + 2 : around.min()[a] - 2; };
      bounds.expand(sphere->indexToWorld(openvdb::Coord(corner(0), corner(1), corner(2))));
    }
    const openvdb::Coord low = openvdb::Coord::floor(heat->worldToIndex(bounds.min())).offsetBy(-1);
    const openvdb::Coord high = openvdb::Coord::ceil(heat->worldToIndex(bounds.max())).offsetBy(1);
    for (auto at = openvdb::CoordBBox(low, high).begin(); at; ++at)
    {
      heat->tree().setValueOnly(*at, field(heat->indexToWorld(*at)));
    }
    velocity->fill(around.expandBy(2), openvdb::Vec3s(1.0f, 2.0f, -3.0f));
    file.write({ sphere, heat, velocity });

    Reading reading(file.name());
    reading.reader->SetGridName("sphere");
    reading.reader->SetConversion(conversion);
    reading.reader->SetThreshold(-100.0);
    reading.reader->SetColorGridName("heat");
    const svo::Octree octree = reading.octree();
    vtkDataArray* values = svo::leafValues(reading.output(), "heat");
    ASSERT_NE(values, nullptr) << reading.messages.all();
    ASSERT_NE(reading.output()->GetCellData()->GetArray("heat"), nullptr);
    EXPECT_EQ(values->GetDataType(), VTK_DOUBLE);
    std::size_t far = 0;
    vtkIdType leaf = 0;
    svo::forEachCell(octree, octree.level(),
      [&](const svo::OctreeCell& c)
      {
        const glm::dvec3 p = placeOf(octree, { c.cell.x, c.cell.y, c.cell.z });
        const double off = values->GetComponent(leaf++, 0) - field({ p.x, p.y, p.z });
        // On the plane, which is in the voxel; of voxels in their middles, but for rounding.
        const glm::dvec3 along = glm::abs(glm::transpose(glm::dmat3(octree.transform())) * slope);
        const double most = octree.header().voxelSize * (along.x + along.y + along.z) *
          (conversion == vtkSVOVDBReader::VOXELS ? 1e-3 : 0.501);
        far += std::abs(off) > most;
        return true;
      });
    EXPECT_EQ(far, 0u);
    EXPECT_EQ(leaf, values->GetNumberOfTuples());

    reading.reader->SetColorGridName("velocity");
    vtkDataArray* vectors = svo::leafValues(reading.output(), "velocity");
    ASSERT_NE(vectors, nullptr);
    ASSERT_EQ(vectors->GetNumberOfComponents(), 3);
    EXPECT_NEAR(vectors->GetComponent(5, 2), -3.0, 1e-5);
    EXPECT_EQ(reading.output()->GetFieldData()->GetArray("heat"), nullptr);
    reading.reader->SetColorGridName("None");
    EXPECT_EQ(reading.output()->GetFieldData()->GetArray("velocity"), nullptr);
    EXPECT_EQ(reading.messages.all(), "");
    reading.reader->SetColorGridName("nothing");
    EXPECT_TRUE(reading.octree());
    EXPECT_NE(
      reading.messages.all().find("has no colours: it has no grid \"nothing\""), std::string::npos)
      << reading.messages.all();
  }
}
