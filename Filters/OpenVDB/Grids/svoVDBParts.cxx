#include "svoVDBParts.h"

#include "svoVDBLeaves.h"
#include "svoVDBOctree.h"

#include <sstream>
#include <vector>

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>
#include <openvdb/tools/ValueTransformer.h>

namespace svo
{
namespace
{
std::vector<unsigned char> bytesOf(const openvdb::GridCPtrVec& grids)
{
  if (grids.empty())
  {
    return {};
  }
  std::ostringstream out(std::ios::binary);
  openvdb::io::Stream(out).write(grids);
  const std::string text = out.str();
  return { text.begin(), text.end() };
}

openvdb::GridPtrVec gridsOf(const unsigned char* begin, const unsigned char* end)
{
  if (begin == end)
  {
    return {};
  }
  std::istringstream in(std::string(begin, end), std::ios::binary);
  return *openvdb::io::Stream(in, false).getGrids();
}

bool isMask(const openvdb::GridBase& grid)
{
  return grid.getName() == LeavesName && grid.isType<openvdb::BoolGrid>();
}

bool haveTheSameVoxels(const openvdb::GridBase& a, const openvdb::GridBase& b)
{
  const auto text = [](const openvdb::GridBase& grid)
  { return grid[LevelMetadata] ? grid[LevelMetadata]->str() : std::string(); };
  return a.transform() == b.transform() && text(a) == text(b);
}

/// Adds the voxels of another mask.
void join(openvdb::BoolGrid& mask, const openvdb::BoolGrid& other)
{
  mask.tree().topologyUnion(other.tree());
  // By one thread: values of a leaf are bits of the same words.
  openvdb::tools::foreach (
    mask.beginValueOn(), [](const openvdb::BoolGrid::ValueOnIter& i) { i.setValue(true); }, false);
}
}

void joinGrids(Processes& processes, openvdb::GridCPtrVec& grids, std::string& message)
{
  std::vector<unsigned char> all;
  std::vector<std::size_t> begins;
  processes.gather(bytesOf(grids), all, begins);
  if (processes.self() != 0)
  {
    return;
  }
  openvdb::GridCPtrVec joined;
  openvdb::BoolGrid::Ptr mask;
  for (int i = 0; i < processes.count(); ++i)
  {
    for (const openvdb::GridBase::Ptr& grid :
      gridsOf(all.data() + begins[i], all.data() + begins[i + 1]))
    {
      if (!isMask(*grid))
      {
        joined.push_back(grid);
      }
      else if (!mask)
      {
        mask = openvdb::gridPtrCast<openvdb::BoolGrid>(grid);
        joined.push_back(mask);
      }
      else if (haveTheSameVoxels(*mask, *grid))
      {
        join(*mask, static_cast<const openvdb::BoolGrid&>(*grid));
      }
      else
      {
        message = "the processes' parts have voxels of their own";
        return;
      }
    }
  }
  if (mask)
  {
    openvdb::tools::prune(mask->tree());
  }
  grids = joined;
}
}
