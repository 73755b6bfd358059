// Grids arrive from files: whatever is in one, it becomes an octree of its own voxels or is refused
// with a message, and goes out and comes back the same.
//
// One input is a grid's type, class, map, voxels and tiles, in the order of the bytes; OpenVDB's
// own parser is not what is looked at.
#include "svoFuzzMesh.h"

#include "svoMeshOctree.h"
#include "svoOctreeCells.h"
#include "svoVDBGrids.h"
#include "svoVDBLeaves.h"
#include "svoVDBLevelSet.h"
#include "svoVDBOctree.h"

#include "vtkNew.h"
#include "vtkPolyData.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace
{
[[noreturn]] void fail(const char* what, const std::string& more = {})
{
  std::fprintf(stderr, "FuzzVDB: %s %s\n", what, more.c_str());
  std::abort(); // a finding, for libFuzzer and for the replay alike
}

/// Numbers from the input; 0 at its end.
class Input
{
public:
  Input(const std::uint8_t* data, std::size_t size)
    : At(data)
    , End(data + size)
  {
  }
  bool more() const { return this->At < this->End; }
  template <class T>
  T take()
  {
    T value{};
    const std::size_t size = std::min(sizeof(T), static_cast<std::size_t>(this->End - this->At));
    std::memcpy(&value, this->At, size);
    this->At += size;
    return value;
  }
  /// Most are near, some far, some at the very ends of what an index can be.
  std::int32_t coordinate(int kind)
  {
    return kind == 0 ? this->take<std::int32_t>()
      : kind == 1    ? this->take<std::int16_t>()
                     : this->take<std::int8_t>();
  }
  double number()
  {
    const auto kind = this->take<std::uint8_t>() % 4;
    return kind == 0 ? this->take<double>()
      : kind == 1    ? this->take<float>()
                     : this->take<std::int8_t>() / 16.0;
  }

private:
  const std::uint8_t* At;
  const std::uint8_t* End;
};

template <class GridT>
openvdb::GridBase::Ptr gridOf(Input& in)
{
  using ValueT = typename GridT::ValueType;
  const auto value = [&]
  {
    const double number = in.number();
    if constexpr (std::is_same_v<ValueT, bool>)
    {
      return number > 0.0;
    }
    else if constexpr (std::is_integral_v<ValueT>)
    {
      return static_cast<ValueT>(std::abs(number) < 1e9 ? number : 0.0);
    }
    else
    {
      return static_cast<ValueT>(
        std::abs(number) > std::numeric_limits<ValueT>::max() ? ValueT(0) : number);
    }
  };
  typename GridT::Ptr grid = GridT::create();
  const auto flags = in.take<std::uint8_t>();
  grid->setGridClass(flags & 1 ? openvdb::GRID_LEVEL_SET : openvdb::GRID_UNKNOWN);
  if (flags & 2)
  {
    grid->insertMeta(svo::LevelMetadata, openvdb::Int32Metadata(in.take<std::int8_t>()));
  }
  if (flags & 4)
  {
    openvdb::math::Mat4d map = openvdb::math::Mat4d::identity();
    for (int i = 0; i < 12; ++i)
    {
      map(i / 3, i % 3) = in.number();
    }
    try
    {
      grid->setTransform(openvdb::math::Transform::createLinearTransform(map));
    }
    catch (const openvdb::Exception&)
    {
      // OpenVDB refuses singular ones itself.
    }
  }
  for (int n = 0; n < 4000 && in.more(); ++n)
  {
    const auto what = in.take<std::uint8_t>();
    const int kind = what >> 4;
    openvdb::Coord at;
    for (int i = 0; i < 3; ++i)
    {
      at[i] = in.coordinate(kind);
    }
    switch (what & 15)
    {
      case 0:
        grid->tree().addTile(what & 16 ? 1 : 2, at, value(), true);
        break;
      case 1:
        grid->tree().setValueOff(at);
        break;
      case 2:
        if (kind == 0)
        {
          grid->tree().addTile(3, at, value(), true);
        }
        break;
      case 3: // a box
        grid->tree().fill(
          openvdb::CoordBBox(openvdb::Coord(at.x() % 100, at.y() % 100, at.z() % 100),
            openvdb::Coord(at.x() % 100 + 9, at.y() % 100 + 5, at.z() % 100 + 7)),
          value(), true);
        break;
      default:
        grid->tree().setValue(at, value());
    }
  }
  return grid;
}

void checkOut(const svo::Octree& octree, vtkPolyData* hull)
{
  vtkNew<vtkPolyData> again;
  const openvdb::BoolGrid::Ptr leaves = svo::leavesOf(octree);
  if (leaves->activeVoxelCount() != octree.header().voxelCount)
  {
    fail("the leaves are others than the voxels");
  }
  const svo::SourceOctree built = svo::octreeOfGrid(*leaves, svo::VDBOptions(), again);
  if (built.message.empty() && built.voxels != octree.header().voxelCount)
  {
    fail("voxels were lost on the way out and in");
  }
  if (octree.header().voxelCount < 300)
  {
    std::string message;
    svo::levelSetOf(octree, hull, 2.0, nullptr, message);
  }
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  openvdb::initialize();
  Input in(data, size);
  const auto type = in.take<std::uint8_t>();
  const openvdb::GridBase::Ptr grid = type % 8 == 0 ? gridOf<openvdb::DoubleGrid>(in)
    : type % 8 == 1                                 ? gridOf<openvdb::Int32Grid>(in)
    : type % 8 == 2                                 ? gridOf<openvdb::BoolGrid>(in)
    : type % 8 == 3                                 ? gridOf<openvdb::MaskGrid>(in)
                                                    : gridOf<openvdb::FloatGrid>(in);
  svo::VDBOptions options;
  options.conversion = static_cast<svo::VDBConversion>(type / 8 % 3);
  options.threshold = type / 24 % 2 ? 0.0 : 0.25;
  options.memoryLimit = 16u << 20;
  vtkNew<vtkPolyData> hull;
  const svo::SourceOctree built = svo::octreeOfGrid(*grid, options, hull);
  if (!built.message.empty())
  {
    if (hull->GetNumberOfCells() != 0)
    {
      fail("there is a hull without an octree", built.message);
    }
    return 0;
  }
  svo::Octree octree;
  std::string message;
  if (svo::openAttachedOctree(hull, octree, message) != svo::Attached::Found)
  {
    fail("what was built does not open:", message);
  }
  svofuzz::traced += octree.header().voxelCount > 0;
  const bool all =
    !svo::isSurface(*grid, options.conversion) && (grid->isType<openvdb::MaskGrid>());
  if (all && octree.header().voxelCount != grid->activeVoxelCount())
  {
    fail("a mask has other voxels than its octree");
  }
  if (octree.header().voxelCount < 100000)
  {
    checkOut(octree, hull);
  }
  return 0;
}
