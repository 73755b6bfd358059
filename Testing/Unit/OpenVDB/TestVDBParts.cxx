// Grids of parts of a surface that several processes hold, joined to those of the whole.
#include "svoVDBLeaves.h"
#include "svoVDBLevelSet.h"
#include "svoVDBParts.h"
#include "svoVDBTest.h"
#include "vtkPolyDataToSVO.h"

namespace
{
using namespace svotest;

/// One of two processes, which knows what the other has.
class OneOfTwo : public svo::Processes
{
public:
  int me = 0;
  std::vector<unsigned char> given, others;
  int count() const override { return 2; }
  int self() const override { return this->me; }
  void gather(const std::vector<unsigned char>& own, std::vector<unsigned char>& all,
    std::vector<std::size_t>& begins) override
  {
    this->given = own;
    const auto& first = this->me == 0 ? own : this->others;
    const auto& second = this->me == 0 ? this->others : own;
    all = first;
    all.insert(all.end(), second.begin(), second.end());
    begins = { 0, first.size(), all.size() };
  }
  void minimum(std::vector<std::uint64_t>&) override {}
};

/// What process 0 has after both have joined their grids.
openvdb::GridCPtrVec joined(
  const openvdb::GridCPtrVec& zero, const openvdb::GridCPtrVec& one, std::string& message)
{
  OneOfTwo processes;
  processes.me = 1;
  openvdb::GridCPtrVec grids = one;
  svo::joinGrids(processes, grids, message);
  EXPECT_EQ(grids, one) << "the others keep what they have";
  processes.others = processes.given;
  processes.me = 0;
  grids = zero;
  svo::joinGrids(processes, grids, message);
  return grids;
}

/// The octree of a sphere between two angles from the pole, in the cube of all of it.
svo::Octree octreeOfZone(double from, double to, double edge = 2.0)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(1.0);
  source->SetThetaResolution(64);
  source->SetPhiResolution(17);
  source->SetStartPhi(from);
  source->SetEndPhi(to);
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetMaximumLevel(6);
  filter->SetModelBounds(-edge, edge, -edge, edge, -edge, edge);
  filter->Update();
  return octreeOf(filter->GetOutput());
}

openvdb::BoolGrid::ConstPtr maskOf(const openvdb::GridCPtrVec& grids)
{
  return openvdb::gridConstPtrCast<openvdb::BoolGrid>(grids.at(0));
}
}

TEST(VDBParts, LeavesAreThoseOfBoth)
{
  openvdb::initialize();
  const auto upper = svo::leavesOf(octreeOfZone(0.0, 90.0));
  const auto lower = svo::leavesOf(octreeOfZone(90.0, 180.0));
  std::string message;
  const openvdb::GridCPtrVec all = joined({ upper }, { lower }, message);
  EXPECT_EQ(message, "");
  ASSERT_EQ(all.size(), 1u);
  const auto mask = maskOf(all);
  std::size_t both = 0;
  for (const auto& part : { upper, lower })
  {
    for (auto i = part->cbeginValueOn(); i; ++i)
    {
      both += part == upper && lower->tree().isValueOn(i.getCoord());
      ASSERT_TRUE(mask->tree().isValueOn(i.getCoord()) && mask->tree().getValue(i.getCoord()));
    }
  }
  EXPECT_GT(both, 0u) << "the equator";
  EXPECT_EQ(mask->activeVoxelCount(), upper->activeVoxelCount() + lower->activeVoxelCount() - both);
  EXPECT_TRUE(mask->transform() == upper->transform());
}

TEST(VDBParts, AProcessMayHaveNothingOrAll)
{
  openvdb::initialize();
  const svo::Octree octree = octreeOfZone(0.0, 180.0);
  const auto leaves = svo::leavesOf(octree);
  const auto surface = openvdb::FloatGrid::create(3.0f);
  surface->setName("surface");
  std::string message;
  for (const bool first : { true, false })
  {
    const openvdb::GridCPtrVec both{ leaves, surface };
    const openvdb::GridCPtrVec all = first ? joined(both, {}, message) : joined({}, both, message);
    EXPECT_EQ(message, "");
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(maskOf(all)->activeVoxelCount(), leaves->activeVoxelCount());
    EXPECT_EQ(all[1]->getName(), "surface");
  }
  EXPECT_TRUE(joined({}, {}, message).empty());
}

TEST(VDBParts, PartsWithVoxelsOfTheirOwnAreRefused)
{
  openvdb::initialize();
  std::string message;
  joined({ svo::leavesOf(octreeOfZone(0.0, 90.0)) },
    { svo::leavesOf(octreeOfZone(90.0, 180.0, 3.0)) }, message);
  EXPECT_NE(message.find("voxels of their own"), std::string::npos);
}
