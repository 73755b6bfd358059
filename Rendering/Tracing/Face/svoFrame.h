// A frame: its settings, the picture, its statistics, and its shadow maps.
#ifndef svoFrame_h
#define svoFrame_h

#include "svoLight.h"
#include "svoRay.h"
#include "svoTracerSettings.h"
#include "svoView.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace svo
{
class SkyPicture;

/// What a frame is to bring beside its picture, and what it may leave out.
struct FrameNeeds
{
  /// Names the OpenGL context that is current: tracers with the same one share octrees there. Null:
  /// they share none.
  const void* context = nullptr;
  /// Of the texels of a shadow map so many along an edge become one, and may look so many times as
  /// wide: the same maps, coarser, in less time.
  double shadowCoarseness = 1.0;
  /// Instances whose rectangle has fewer pixels are not drawn; they cast. 0: all are.
  double detailThreshold = 0.0;
  /// Samples of lights with a size and of ambient occlusion in this frame, if lightSamples are
  /// more. Where a picture of the same has more already it stays.
  int samplesNow = std::numeric_limits<int>::max();
  /// Rasterised surfaces look up shadow maps inside of Scene::receivers: what the eye may see of
  /// these is traced, and the maps are handed out.
  bool receiverMaps = false;
  /// Of the sky's light, in the place of two colours; or null.
  std::shared_ptr<const SkyPicture> skyPicture;
  /// ... or anywhere: all is traced, and handed out.
  bool wholeShadowBuffers = false;
  /// ... of lights that are sampled, too: some look up what Tracer::receiverShares() does not have.
  bool sampledMaps = false;
  /// VTK draws what is seen, by Tracer::eyeCode() what is seen of the instances, if the tracer has
  /// it; the others only cast. What asks for their shadows does so by Tracer::lightCode().
  bool lightCode = false;
  /// ... and exact rays may be shadow volumes: the same shadows (LightCode::volumes).
  bool shadowVolumes = false;
  bool writeNormals = false; // Frame::normals is wanted (SSAO)
  bool writeLight = false;   // Frame::light is wanted (tone mapping)
  bool writeSlopes = false;  // Frame::slopes is wanted (multisampling)
  bool writeNames = true;    // Frame::instance and Frame::primitive are wanted

  bool handsOutMaps() const { return this->receiverMaps || this->wholeShadowBuffers; }
};

/// With antiAliasing there are four rays in pixels at whose border the instance, the depth or a
/// shadow changes. Colours are averaged over what is hit; depth stays that of the pixel's centre,
/// and a pixel whose centre misses stays a miss. Shadow buffers are traced whole.
struct FrameSettings
  : TracerSettings
  , FrameNeeds
{
  /// True if points ask what is all around them.
  bool asksHemispheres() const { return this->ambientOcclusion || this->skyLight; }
  /// True if points ask the casters what is before a light, and not maps of these.
  bool asksCasters() const
  {
    return this->shadowTechnique != ShadowTechnique::None &&
      this->shadowTechnique != ShadowTechnique::Buffer;
  }
  /// Where filterShadows has an effect: MapTest::darkness() is asked instead of yes or no.
  bool filters() const
  {
    return this->filterShadows && this->automaticBias &&
      this->shadowTechnique == ShadowTechnique::Buffer;
  }
};

/// What a tile of 8x8 pixels of a frame holds; those of its border may be smaller.
struct FrameTile
{
  enum class Kind : std::uint8_t
  {
    Empty,
    Mixed, // some pixels are hits
    Whole  // all are
  };
  Kind kind = Kind::Empty;
  std::uint64_t version = 0; // Frame::version when it was written last
};

/// Where a tracer leaves its picture to OpenGL: names of textures, in the context in which render()
/// was called. They are two-dimensional, as large as the frame, not filtered, and the tracer's. 0:
/// there is none.
struct FrameImages
{
  unsigned int color = 0, depth = 0; // depth and all that follow as the arrays of Frame have it
  unsigned int normals = 0, slopes = 0, light = 0;
};

/// The picture, row by row from the lower left, one entry a pixel.
struct Frame
{
  static constexpr int TileSize = 8; // pixels

  int width = 0;
  int height = 0;
  /// Another one whenever the tracer has written to it; 0: it does not say.
  std::uint64_t version = 0;
  PixelRect covered;               // smallest rectangle (8-pixel grid) with every hit
  std::vector<std::uint8_t> color; // RGBA; alpha 255 on a hit, 0 elsewhere
  std::vector<float> depth;        // OpenGL window depth; 1 where nothing was hit
  std::vector<float> normals;      // xyz, view space, if asked for; 0 of unlit surfaces
  /// How `depth` grows on the facet that a pixel shows, to the right and upwards, a pixel, if asked
  /// for; 0 where nothing was hit, or where VTK's mappers give a whole pixel one depth.
  std::vector<float> slopes;
  std::vector<float> light;            // RGB that `color` has cut to 0..1, on hits, if asked for
  std::vector<std::uint32_t> instance; // index into Scene::instances, or ~0u; if asked for
  std::vector<Primitive> primitive;    // if asked for
  /// Tile by tile, row by row from the lower left; empty: the tracer does not say.
  std::vector<FrameTile> tiles;
  /// In the place of `color`, `depth`, `normals`, `slopes` and `light`, which are empty then.
  FrameImages images;

  bool onGPU() const { return this->images.color != 0; }
  /// False where VTK draws all that is seen (Tracer::eyeCode()).
  bool hasPicture() const { return this->onGPU() || !this->color.empty(); }
  bool hasNormals() const { return !this->normals.empty() || this->images.normals != 0; }
  bool hasSlopes() const { return !this->slopes.empty() || this->images.slopes != 0; }
  bool hasLight() const { return !this->light.empty() || this->images.light != 0; }
};

/// What a part of a frame took, seconds.
struct PhaseTime
{
  double wall = 0.0;
  double processor = 0.0; // of all threads of the program
};

/// What was done for a frame; nothing, where its picture stays.
struct FrameCounts
{
  std::uint64_t primaryRays = 0;
  std::uint64_t shadowRays = 0;
  std::uint64_t retracedLayers = 0; // traced or drawn, of the eye and of lights
};

struct FrameStatistics : FrameCounts
{
  double traceTime = 0.0;    // s, depth layers of the eye, merging, shading
  double shadowTime = 0.0;   // s, shadow buffers or rays
  PhaseTime eye;             // depth layers of the eye, merged
  PhaseTime mark;            // what visible points will look up of the lights
  PhaseTime lights;          // shadow buffers, those shared with other processes apart
  PhaseTime shade;           // shading and shadow tests; shadow rays
  int lightsWithBuffers = 0; // casting lights whose shadows were found so
  int lightsWithRays = 0;
  std::uint64_t shadowVolumes = 0; // casters, once a light
  std::uint64_t contourEdges = 0;  // at which they begin
  /// A pixel, of lights with a size and of ambient occlusion; 0: there are none.
  int lightSamples = 0;
  double samplingTime = 0.0; // s, of the shading, in which they were taken
  /// How far off what they say of each light may be by chance: RMS of all pixels, 255ths of a whole
  /// one; negative: not known.
  double lightNoise = 0.0;
  /// How far the picture is from that of fewer samples which it has replaced, RMS of colours of
  /// 0..255 where something was hit; negative: it has replaced none.
  double lightError = -1.0;
  std::uint64_t layerMemory = 0;  // bytes held by kept layers
  std::uint64_t shadowMemory = 0; // bytes held by shadow buffers and what was handed out of them
  std::uint64_t gpuMemory = 0;    // bytes of octrees there
  /// Visible instances that the eye's layers were made without: outside of the view, hidden by
  /// others, or below the detailThreshold.
  std::uint64_t outsideInstances = 0, hiddenInstances = 0, smallInstances = 0;
  /// Casters in the lights' maps, or volumes, once each, that were not looked at: their shadows
  /// fall on nothing that is seen, or into others'.
  std::uint64_t sparedCasters = 0;
  double largestSmallInstance = 0.0; // pixels, the longest edge of a rectangle that was left out
  /// How wide texels look at most in the shadow maps that were fitted to the eye's view, pixels; 0:
  /// no map was.
  double coarsestTexel = 0.0;
  double widestTexel = 0.0; // no texel of any map looks wider, pixels
  bool fewerTexels = false; // than were asked for, by all processes alike, for lack of memory
  /// Largest voxel, pixels, of visible octrees that are coarser than the frame needs, where they
  /// are not traced exactly.
  double coarsestVoxel = 0.0;
  /// How far from the surface of a receiver in view its shadows may begin, pixels, however deep its
  /// octree is; 0 without shadows.
  double largestGap = 0.0;

  /// True if shading is, for the most part, asking casters.
  bool askedCasters() const { return this->lightsWithRays > 0; }
};

/// Texels of a shadow map in tiles of 8x8. Those tiles are held in which a caster lies.
struct ShadowTexels
{
  static constexpr std::uint32_t Nothing = ~0u;
  static constexpr std::size_t InTile = 64;

  int tilesX = 0;
  std::vector<std::uint32_t> tiles; // row by row: which of those held it is, or Nothing
  std::size_t stride = InTile;      // numbers in a tile that is held
  /// Of each tile that is held, row by row, linear depths less ShadowMap::base; infinity where
  /// nothing lies. Of translucent casters, as often, the share of the light that each takes, 0..1;
  /// 0 where there is none.
  std::vector<float> numbers;

  std::size_t held() const { return this->numbers.size() / this->stride; }
  float depthAt(int x, int y) const
  {
    const float* number = this->numberAt(x, y);
    return number ? *number : std::numeric_limits<float>::infinity();
  }
  /// Of translucent casters.
  float shareAt(int x, int y) const
  {
    const float* number = this->numberAt(x, y);
    return number ? number[InTile] : 0.0f;
  }

private:
  const float* numberAt(int x, int y) const
  {
    const std::uint32_t tile =
      this->tiles[static_cast<std::size_t>(y >> 3) * this->tilesX + (x >> 3)];
    return tile == Nothing ? nullptr : &this->numbers[this->stride * tile + 8 * (y & 7) + (x & 7)];
  }
};

/// A finished shadow buffer, for rasterised receivers. One per map: a point light whose casters
/// subtend more than 120 degrees has six, and so has each group of its translucent casters. What
/// reaches a point is the product of what the opaque ones and each of those groups leave.
struct ShadowMap
{
  int light = 0; // index into Scene::lights
  View view;     // of the light; width = height = resolution
  double base = 0.0;
  /// From frame to frame the same object as long as the values are the same. Null where the map
  /// lies in OpenGL: Tracer::mapTexture().
  std::shared_ptr<const ShadowTexels> texels;
  int layer = 0;            // there; below 0: nothing lies in it
  int group = 0;            // 0: of opaque casters; else the number of a group of translucent ones
  double worldBias = 0.0;   // for receivers that do not know the caster of a texel, world units
  double casterVoxel = 0.0; // of the coarsest caster, world units
};
}

#endif
