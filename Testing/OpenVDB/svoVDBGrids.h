// The grids that tests make. OpenVDB's library has no instances of them that others may use:
// whoever makes a grid compiles all of its methods, for a minute. These are compiled once
// (svoVDBGrids.cxx).
#ifndef svoVDBGrids_h
#define svoVDBGrids_h

#include <openvdb/openvdb.h>

#define SVO_VDB_GRIDS(INSTANCE)                                                                    \
  INSTANCE(openvdb::BoolTree)                                                                      \
  INSTANCE(openvdb::DoubleTree)                                                                    \
  INSTANCE(openvdb::FloatTree)                                                                     \
  INSTANCE(openvdb::Int32Tree)                                                                     \
  INSTANCE(openvdb::Int64Tree)                                                                     \
  INSTANCE(openvdb::MaskTree)                                                                      \
  INSTANCE(openvdb::Vec3STree)

#define SVO_VDB_GRID(TreeT)                                                                        \
  extern template class openvdb::tree::Tree<TreeT::RootNodeType>;                                  \
  extern template class openvdb::Grid<TreeT>;
SVO_VDB_GRIDS(SVO_VDB_GRID)
#undef SVO_VDB_GRID

#endif
