// How deep the octrees of a scene have to be: no deeper than its pixels and texels can show.
#ifndef svoNeededLevels_h
#define svoNeededLevels_h

#include "svoFrame.h"
#include "svoLevels.h"
#include "svoScene.h"
#include "svoView.h"
#include "vtkSVOTracingModule.h"

#include <vector>

namespace svo
{
/// For each instance the levels from which on a deeper octree is traced no deeper (selectLevel()),
/// so that the picture keeps the promise of the pixel error; at most Instance::deepestLevel. The
/// instances have a box and need no octree. The answer depends on the scene, the view and the
/// settings and on nothing else: not on octrees that happen to be there, nor on time.
///
/// The level for lights comes from the texels of the shadow buffers alone. It does not depend on
/// the eye, unless the light is bound to it. Where the technique is automatic that is all that rays
/// get, too: of triangles that are met exactly they meet the same ones. The level for the eye is
/// never less: the lights' octree is built anyway, and a deeper one looks the same where pixels
/// have few triangles (selectEyeLevel()). Rays to lights (ShadowTechnique::Rays) are the exact
/// reference and need the deepest octrees of everything that casts. So does a view without pixels,
/// one that is not known yet, of what is visible.
///
/// No octree is coarser than its mesh: where many triangles share a brick, none of them stands well
/// for a voxel (coarsestLevel()). None is much finer either: triangles that look larger than voxels
/// are traced exactly whatever the level (Instance::detailLevel). A pixel error of 0, a bias in
/// voxels and rays to lights have the level that they ask for.
VTKSVOTRACING_EXPORT std::vector<NeededLevels> neededLevels(
  const Scene& scene, const View& eye, const FrameSettings& settings);

/// The coarsest octree that shows a mesh well, 4 or more, not regarding Instance::deepestLevel: its
/// bricks have eight triangles, few to be intersected one by one, if the mesh covers about as much
/// area as its box.
VTKSVOTRACING_EXPORT int coarsestLevel(const Box& box, std::size_t triangles);
}

#endif
