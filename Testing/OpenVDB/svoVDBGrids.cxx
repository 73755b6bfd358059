#include "svoVDBGrids.h"

#define SVO_VDB_GRID(TreeT)                                                                        \
  template class openvdb::tree::Tree<TreeT::RootNodeType>;                                         \
  template class openvdb::Grid<TreeT>;
SVO_VDB_GRIDS(SVO_VDB_GRID)
