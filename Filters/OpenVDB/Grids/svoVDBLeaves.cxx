#include "svoVDBLeaves.h"

#include "svoLeafTraits.h"
#include "svoOctree.h"
#include "svoOctreeCells.h"
#include "svoVDBOctree.h"
#include "svoVDBTransform.h"

#include <openvdb/tools/Prune.h>

namespace svo
{
openvdb::BoolGrid::Ptr leavesOf(const Octree& octree)
{
  using LeafT = openvdb::BoolTree::LeafNodeType;
  static_assert(LeafT::DIM == 8, "eight bricks are a leaf node");
  openvdb::BoolGrid::Ptr grid = openvdb::BoolGrid::create(false);
  LeafT* leaf = nullptr;
  forEachCell(octree, octree.level(),
    [&](const OctreeCell& cell)
    {
      // In Morton order all voxels of a leaf node follow each other.
      const openvdb::Coord at(cell.cell.x, cell.cell.y, cell.cell.z);
      if (!leaf || leaf->origin() != (at & ~(LeafT::DIM - 1)))
      {
        leaf = grid->tree().touchLeaf(at);
      }
      leaf->setValueOn(LeafT::coordToOffset(at), true);
      return true;
    });
  openvdb::tools::prune(grid->tree());
  grid->setName(LeavesName);
  describe(octree, *grid);
  return grid;
}

void describe(const Octree& octree, openvdb::GridBase& grid)
{
  const Header& h = octree.header();
  grid.setTransform(transformOf(octree));
  grid.setCreator("vtkSVO " VTKSVO_VERSION);
  grid.insertMeta(LevelMetadata, openvdb::Int32Metadata(octree.level()));
  grid.insertMeta(
    "vtksvo_source", openvdb::StringMetadata(octree.hasPlanes() ? "planes" : "triangles"));
  grid.insertMeta("vtksvo_leaf_geometry",
    openvdb::StringMetadata(traitsOf(static_cast<LeafGeometry>(h.leafGeometry)).name));
}
}
