// Which technique finds the shadows of a light: a shadow buffer or exact rays, whichever is
// cheaper.
//
// A buffer's time goes with the texels that are asked for and with the triangles that the light
// sees; that of rays with the points that ask and with the triangles in the beams of their tiles.
// All of that is counted, on a few of the picture's tiles, before anything of the light is traced:
// the choice depends on the scene, the view and the settings, never on a clock. The constants are
// fitted to measured times, so a wrong choice costs time and nothing else: rays are exact, and are
// taken only where they meet the triangles of all casters, so their error is none of a buffer's.
#ifndef svoShadowChoice_h
#define svoShadowChoice_h

#include "svoFrame.h"
#include "svoLayeredView.h"
#include "svoLightDetail.h"
#include "svoScene.h"

#include <vector>

namespace svo
{
/// What a light's shadows ask for, of either technique.
struct ShadowWork
{
  double points = 0.0;        // visible ones
  double freshTexels = 0.0;   // of maps in which anything is traced
  double keptTexels = 0.0;    // of others
  double tracedTexels = 0.0;  // looked up; once for each caster whose outline they are in
  double walkedTexels = 0.0;  // those of casters whose triangles are smaller than texels
  double seenTriangles = 0.0; // of other casters, in the texels that are looked up
  double beamPoints = 0.0;    // once for each caster that may block their rays
  double beamTriangles = 0.0; // in the beams of tiles of points, caster by caster; few of each
  double moreTriangles = 0.0; // the rest of them

  /// Microseconds of processor time, about.
  double bufferTime() const;
  double rayTime() const;
};

/// `eye`: has traced the scene, seen through `view`. `kept`: by index of the instance, 1 if a
/// buffer has its layer already.
ShadowWork shadowWork(const Scene& scene, const View& view, const LayeredView& eye,
  const LightMaps& maps, const std::vector<std::uint8_t>& kept);

/// True if the frame may have lights with rays where its technique is automatic.
bool mayTakeRays(const Scene& scene, const FrameSettings& settings, const LayeredView& eye);
}

#endif
