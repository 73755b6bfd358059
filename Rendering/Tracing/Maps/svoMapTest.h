// Points against the maps of a light: whether they are in its shadow, and how much.
#ifndef svoMapTest_h
#define svoMapTest_h

#include "svoSurfacePoint.h"
#include "svoTilePatch.h"
#include "svoTileShadows.h"
#include "svoTracedMaps.h"

#include <cstdint>

namespace svo
{
/// The maps are borrowed.
class MapTest
{
public:
  explicit MapTest(const TracedMaps& maps)
    : Maps(maps)
  {
  }

  /// True if a caster lies between the light and the point. `error`: how far the point may lie from
  /// the surface that it stands for, world units.
  ///
  /// With the automatic bias texels are asked by shadowTest(), which says why it asks as it does.
  /// Without it the test is the paper's bare `distance > depth` plus `bias` voxels of the caster.
  bool shadows(const SurfacePoint& point, double error) const;

  /// The same of a patch's points, by pixel: those that are `asked` and dark.
  std::uint64_t shadows(const TilePatch& patch, double error, std::uint64_t asked) const;

  /// The share of the light that the point misses, 0..1: the test above, of every texel in a window
  /// around the point, weighted so that it changes smoothly with the point (percentage-closer
  /// filtering: Reeves et al., SIGGRAPH 1987; on the receiver's plane: Isidoro, "Shadow Mapping:
  /// GPU-based Tips and Techniques", GDC 2006). `extent`, world units: how wide a piece of the
  /// surface the point stands for; the window is three texels wide, more only where a piece is
  /// wider than a texel (TexelWindow).
  ///
  /// A texel's answer is that of a texel as large as it takes to hold the point: planes are
  /// followed, and the bend of the surface is allowed for, over the whole way. A nearby occluder
  /// does not count if it is the other side of a crease. Where the map is flat all texels say what
  /// one says, and the test of one is all there is. Without the automatic bias: 0 or 1, as the test
  /// above has it.
  float darkness(const SurfacePoint& point, double error, double extent) const;

  /// The same of a patch's points, by pixel: of those that are `asked`, 0 of others.
  void darkness(const TilePatch& patch, double error, const double* extents, std::uint64_t asked,
    float* darkness) const;

  /// Of maps of translucent casters: the share of the light that these take from a patch's
  /// points, by pixel, 0..1; of those that are `asked`, 0 of others. The test is that of shadows(),
  /// or of darkness() where there are `extents`, and each texel counts as much as what lies there
  /// is opaque.
  void taken(const TilePatch& patch, double error, const double* extents, std::uint64_t asked,
    float* taken) const;

private:
  enum class Answer // of shadowTest()
  {
    Lit = 0,
    DarkNearby = 1, // by an occluder within NearbyReach texels' depth
    Dark = 2
  };
  /// What all texels say of all points of a patch: where everything is farther from the light than
  /// the points' planes are followed to, or all texels hold something that lies before what
  /// shadowTest() follows and allows at most, none of them needs to be looked up.
  enum class TileAnswer
  {
    Lit,
    Dark,
    Unknown
  };
  /// `around`: what lies there. `span`: of ask(), at most.
  TileAnswer answer(const TracedMap& map, const MapPlaces& places, const TileOccluders& around,
    double error, double span = 1.0) const;
  /// Looks up what lies at the texels of points that are sure; returns those where something does.
  /// `theirs`: whose these texels are, all of them, or TileOccluders::Several.
  std::uint64_t occluders(const TracedMap& map, const MapPlaces& places, std::uint32_t theirs,
    double error, TexelTests& tests) const;
  /// Tests these. Returns those that are dark; adds those that have to be tested in double.
  std::uint64_t test(const TracedMap& map, const TilePatch& patch, const MapPlaces& places,
    double error, std::uint64_t& single) const;
  /// True if most of the other texels around the point find it dark as well.
  bool agreed(const MapPlace& place, const SurfacePoint& point, double error) const;
  /// `span`: the size of the texel is taken for so many times what it is.
  Answer ask(const MapPlace& place, const glm::ivec2& texel, const SurfacePoint& point,
    double error, double span = 1.0) const;
  bool shadows(const MapPlace& place, const SurfacePoint& point, double error) const;
  // The filter; svoShadowFilter.cxx has it.
  /// Width of the box for a point that stands for `extent`, texels.
  static double boxWidth(const MapPlace& place, double extent);
  /// The texels of the window hold nothing, or one surface without steps and creases.
  static bool isFlat(const MapPlace& place, double width);
  /// Of points that are sure, those around which it is, as far as patches can tell.
  static std::uint64_t flat(const TracedMap& map, const MapPlaces& places, const double* extents);
  /// What lies at a texel, followed to the point in the way that the map shows from the texel
  /// beyond, passes behind the point: it is the other side of a crease and no occluder.
  bool endsBefore(const MapPlace& place, const glm::ivec2& texel, double error) const;
  /// `weighed`: by how opaque what lies at each texel is.
  float filtered(const MapPlace& place, double width, const SurfacePoint& point, double error,
    bool weighed = false) const;
  // Of translucent casters; svoShadowOpacity.cxx.
  /// What a texel's caster takes, 0..1; 0 where there is none.
  float opacity(const TracedMap& map, const glm::ivec2& texel) const;
  /// The mean of that over what lies in a window.
  float opacity(const MapPlace& place, double width) const;

  const TracedMaps& Maps;
};
}

#endif
