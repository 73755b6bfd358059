// The shadows of a frame: for every casting light a shadow buffer, or exact rays.
#ifndef svoShadows_h
#define svoShadows_h

#include "svoFrame.h"
#include "svoHemisphereRays.h"
#include "svoLightBuffers.h"
#include "svoLightShadow.h"
#include "svoReceivers.h"
#include "svoScene.h"
#include "svoShadowRays.h"
#include "svoTilePatch.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace svo
{
class Shadows
{
public:
  /// Begins a frame, before prepare() or after traceShared(): decides how each light's shadows are
  /// found. `scene`: of the points to be tested; `seen`: with the octrees that lights see.
  void choose(
    const Scene& scene, const Scene& seen, const View& view, const FrameSettings& settings);

  /// Of the buffers, in frames to come.
  void setCulling(const Culling& culling) { this->Cull = culling; }

  /// Fits the lights' buffers and keeps those of their layers that are still true. `scene`: with
  /// the octrees that lights see. `view`: of the eye, which has been traced.
  void prepare(const Scene& scene, const View& view, const Hits& eye, const FrameSettings& settings,
    LayerBudget& budget, const ParallelFor& parallelFor);

  /// To be called in every frame, after prepare() or traceShared(): who answers for each light.
  /// `scene`, `view` and `eye`: those of the points to be tested; rays to the light meet the same
  /// geometry, or surfaces would shadow themselves.
  void prepareAnswers(
    const Scene& scene, const View& view, const Hits& eye, const FrameSettings& settings);

  /// Instead of prepare() and trace() where other processes hold parts of the scene: traces the
  /// buffers whole and merges them with the others', so that all have the same. A collective call.
  /// The lights, the resolution, the pixel error and the eye of the first process count. Where no
  /// process has changed anything the last frame's buffers are true still, wherever the camera
  /// went, unless it makes other maps necessary. Returns false, and nothing is done, if the
  /// processes have different numbers of lights.
  bool traceShared(const Scene& scene, const View& eye, const FrameSettings& settings,
    LayerBudget& budget, const ParallelFor& parallelFor, Processes& processes);

  /// After prepareAnswers(), as all that follows: notes what visible points will look up. Which
  /// side of them is lit does not matter: light tiles that only unlit sides look up are few.
  /// Thread-safe.
  void mark(const TilePatch& patch, LightTiles& noted) const;
  /// The same, of what was noted in the last frame, when the maps were the same.
  void mark(const LightTiles& noted) const;
  /// True if all maps are those of the last frame, and what they show is tested alike.
  bool sameMaps() const;
  /// After trace(): true if any of these tiles does not show what it showed; Hits::changedSince().
  bool changedSince(const LightTiles& noted, std::uint64_t version) const;
  /// True if it matters what mark() notes.
  bool wantsMarks() const { return this->Casting && !this->Samples; }
  /// After trace(): true if points at the terminator may look up something else.
  bool changedSince(const RaisedTiles& noted, std::uint64_t version) const;
  void trace(const ParallelFor& parallelFor) const;

  /// True if all lights can tell whether the point is in their shadow. They can of visible points;
  /// of others only where their buffers happen to be traced.
  bool knows(const glm::dvec3& position) const;

  /// From prepareAnswers() to the end of the frame; by index into Scene::lights.
  const LightShadow& of(std::size_t light) const
  {
    assert(light < this->OfLights.size());
    return *this->OfLights[light];
  }
  /// True if samples answer for the light.
  bool sampled(std::size_t light) const { return this->Soft[light] != 0; }
  SampledPlanes sampledPlanes() const;
  /// Of ambient occlusion, and of a sky's light; null where none was asked for.
  const HemisphereRays* occlusion() const { return this->Occlusion.get(); }
  const HemisphereRays* sky() const { return this->Sky.get(); }
  /// True if some of them ask for ShadowQuery::extents.
  bool filters() const { return this->Filters; }

  void addStatistics(FrameStatistics& statistics) const;
  void copyMaps(std::vector<ShadowMap>& maps) const;
  /// Bytes of all kept layers.
  std::size_t layerMemory() const;
  void release();

private:
  void releaseRays();
  bool usesBuffer(std::size_t light, const FrameSettings& settings) const;
  bool byRays(std::size_t light) const { return this->Techniques[light] == ShadowTechnique::Rays; }
  void chooseAll(const Scene& scene, ShadowTechnique technique);
  void prepareBuffers(const Scene& scene, const std::vector<Light>& lights,
    const std::vector<LightMaps>& maps, std::size_t first, const FrameSettings& settings,
    LayerBudget& budget, const ParallelFor& parallelFor);

  /// Calls f(buffer) for all of the frame.
  template <class F>
  void eachBuffer(const F& f) const
  {
    for (const LightBuffers* const ofLight : this->Buffers)
    {
      if (ofLight)
      {
        ofLight->each(f);
      }
    }
  }

  Culling Cull;
  std::vector<ShadowTechnique> Techniques; // by light
  std::vector<LightMaps> Maps;             // by light
  std::vector<Outline> Fitted;             // what they were fitted to
  std::uint64_t FittedVersion = 0;         // of the scene that they are of
  bool TracesWhole = false;                // every tile is traced
  bool Casting = false;                    // there are buffers
  bool Filters = false;
  bool Samples = false; // points beside pixels' centres look up what nobody has marked
  std::vector<LightBuffers*> Buffers;                          // by light; null: none
  std::vector<const LightBuffers*> BuffersBefore;              // of the last frame
  std::map<std::uint64_t, std::unique_ptr<LightBuffers>> Kept; // by Light::id
  std::unique_ptr<RayCasters> Casters;                         // where somebody asks rays
  std::unique_ptr<ShadowRays> Rays;                            // through these
  std::unique_ptr<HemisphereRays> Occlusion, Sky;
  std::vector<std::unique_ptr<LightShadow>> OfLights;
  std::vector<std::uint8_t> Soft;         // by light
  std::vector<unsigned char> SharedState; // inputs of the shared buffers in Kept; empty: not shared
  bool Traced = false;                    // buffers were, in this frame
  TexelWidths Widths;                     // of all lights, by all processes alike
};
}

#endif
