// What is placed in the world by instances: an octree and its mesh's arrays. Copies of an object
// share one. Arrays are borrowed and must live as long as the frame.
#ifndef svoBody_h
#define svoBody_h

#include "svoAttributes.h"
#include "svoBox.h"
#include "svoOctree.h"

#include <cstddef>

namespace svo
{
struct Body
{
  Octree octree;
  /// The octree that shadow buffers are traced through instead of `octree`, if it is not empty. The
  /// eye may need a deeper octree than the lights do; through that one, shadows would change when
  /// the camera comes closer.
  Octree casterOctree;
  LeafGeometry leafGeometry = LeafGeometry::Automatic;
  /// The mesh stands for the ball of radius 1 around its origin, inside of which it lies. Lights'
  /// maps meet the ball itself; see svoTileBalls.h.
  bool ball = false;
  Attributes attributes;
  /// With them surfaces of different octrees that have the same vertices are equally deep.
  MeshPoints points;

  // Where octrees are built no deeper than they are needed; see svoNeededLevels.h.
  Box box;                   // the mesh's own, local; stands for the octree until there is one
  std::size_t triangles = 0; // of the mesh, or about as many
  int deepestLevel = 0;      // that the mesh's octree may have; 0: the one that `octree` has
  int detailLevel = 0;       // from which on its bricks have few triangles, all exact; 0: unknown
  int neededLevel = 0; // that this frame needs: `octree` is coarser while it is being deepened
};
}

#endif
