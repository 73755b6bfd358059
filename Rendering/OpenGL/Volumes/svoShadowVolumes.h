// The shadow volumes of a scene's casters: their contours as the lights see them, kept as long as
// light and caster lie to each other as they did, in the memory of an OpenGL context.
#ifndef svoShadowVolumes_h
#define svoShadowVolumes_h

#include "svoBufferTexture.h"
#include "svoFrame.h"
#include "svoLightContour.h"
#include "svoMapCopies.h"
#include "svoMeshEdges.h"
#include "svoParallel.h"
#include "svoScene.h"
#include "svoView.h"
#include "svoVolumeDraws.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/vec4.hpp>

namespace svo
{
class OctreeArena;
struct LightCode;

/// True of casters that have a volume: opaque ones of triangles.
bool hasVolume(const Instance& caster);

/// Of one renderer. All calls are made in its context; whoever owns one is told before it goes.
class ShadowVolumes
{
public:
  /// Adds the volumes that the code's lights make of those of `casters` that have one, whose
  /// octrees `arena` holds: at most `room` bytes. Why there are none, in a sentence, else empty.
  std::string describe(const Scene& scene, const std::vector<CasterInMemory>& casters,
    const OctreeArena& arena, const View& view, const FrameSettings& settings, std::size_t room,
    const ParallelFor& parallelFor, LightCode& code);
  /// True if that is for want of room, and it was tried.
  bool lacksRoom() const { return this->LacksRoom; }
  void release();
  /// ... and what did not fit into the memory of a context that goes.
  void forget()
  {
    this->release();
    this->TooMuch = {};
  }

  std::size_t bytes() const
  {
    return this->Edges.bytes() + this->Casters.bytes() + this->Senses.bytes();
  }
  /// Of the last call: volumes; casters, once a light, that have none, since their shadows fall on
  /// nothing that is seen; edges that volumes begin at.
  std::size_t volumes() const { return this->Volumes; }
  std::size_t spared() const { return this->Spared; }
  std::size_t contourEdges() const { return this->ContourEdges; }

private:
  /// What a light sees of a caster.
  struct Seen
  {
    std::uint64_t octree = 0;
    glm::dvec4 light{ 0.0 }; // octree coordinates
    LightContour contour;
    std::vector<std::uint32_t> senses;
    std::uint64_t version = 0; // another one wherever the contour is another
    bool current = false;      // a part of this frame
  };
  static constexpr std::uint64_t Changed = 0; // as a version: it is to have another one
  struct Volume
  {
    const Instance* instance;
    std::size_t number; // of the light
    glm::dvec4 light;   // octree coordinates
    double end; // how far along the light it reaches, from the eye on, world; VolumeReach::Endless
    VolumeDraws::Sides way;
    Seen* seen;
  };
  std::shared_ptr<const VolumeDraws> place(const Scene& scene,
    const std::vector<CasterInMemory>& casters, const OctreeArena& arena, const View& view,
    const FrameSettings& settings, std::size_t room, const std::vector<int>& lights,
    const ParallelFor& parallelFor);
  std::vector<Volume> gather(const Scene& scene, const std::vector<CasterInMemory>& casters,
    const View& view, const FrameSettings& settings, const std::vector<int>& lights);
  void see(const std::vector<Volume>& volumes, const FrameSettings& settings,
    const ParallelFor& parallelFor);
  void see(const Volume& volume, bool keeps) const;
  bool send(const std::vector<Volume>& volumes, const OctreeArena& arena);
  bool aim(const std::vector<Volume>& volumes, const View& view);

  std::map<std::uint64_t, std::unique_ptr<const MeshEdges>> Meshes; // by Octree::id()
  std::map<std::pair<std::uint64_t, std::uint64_t>, Seen> Kept;     // by caster and light
  std::uint64_t Versions = 0;
  // What was sent: by volume what it is of, and where its senses begin; ranges; matrices.
  std::vector<std::tuple<std::size_t, int, std::uint64_t, std::uint32_t>> Sent;
  std::vector<std::uint32_t> FirstSenses;
  std::vector<VolumeDraws::OfLight> Ranges;
  std::vector<glm::vec4> Aimed;
  BufferTexture Edges{ BufferTexture::Texel::FourWords };
  BufferTexture Casters{ BufferTexture::Texel::FourFloats };
  BufferTexture Senses{ BufferTexture::Texel::Word };
  std::size_t Volumes = 0, Spared = 0, ContourEdges = 0;
  bool LacksRoom = false;
  /// Of a frame whose volumes did not fit: the scene, the limit, the picture, and how many there
  /// were; and the room, which others' octrees may make less.
  std::tuple<std::uint64_t, std::size_t, int, int, std::size_t> TooMuch;
  std::size_t TooLittle = 0;
};
}

#endif
