// The interface of all tracers: the calls of a renderer, and their order.
//
// Fill a Scene with instances and ask neededLevels() how deep their octrees have to be; give them
// octrees; render(). Where a scene is spread over several processes all of them call shareShadows()
// before render(). Afterwards rasterised surfaces ask for shadowMaps(), and windows with
// multisampling for divideEdges().
#ifndef svoTracer_h
#define svoTracer_h

#include "svoFrame.h"
#include "svoLevels.h"
#include "svoParallel.h"
#include "svoReceivers.h"
#include "svoScene.h"
#include "svoView.h"
#include "vtkSVOTracingModule.h"

#include <memory>
#include <vector>

#include <glm/vec2.hpp>

namespace svo
{
class Processes;
struct EyeCode;
struct LightCode;
struct Silhouettes;

class VTKSVOTRACING_EXPORT Tracer
{
public:
  Tracer() = default;
  virtual ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// For each instance how deep its octrees have to be, so that a frame keeps the promise of its
  /// pixel error. The instances have a box and need no octree. The answer depends on the scene, the
  /// view and the settings alone.
  virtual std::vector<NeededLevels> neededLevels(
    const Scene& scene, const View& view, const FrameSettings& settings) const = 0;

  /// Renders a frame. Where the scene is shown in a window its OpenGL context is current. Layers
  /// kept from previous frames are used where the settings allow it, and change no bit. A frame
  /// that would be as it is keeps its version, and may be left alone.
  virtual void render(const Scene& scene, const View& view, const FrameSettings& settings,
    const ParallelFor& parallelFor) = 0;

  /// The frame, which is the tracer's, from render() to the next one. Whoever shows it may exchange
  /// pixels, and puts them back (Silhouettes).
  virtual Frame& frame() = 0;

  /// For scenes that are spread over several processes, to be called by all of them before
  /// render() and with the same scene and view: traces the shadow buffers and merges them with the
  /// others'. render() then takes these instead of its own. False if it takes its own: no light
  /// casts, or one of the processes has no memory for it.
  virtual bool shareShadows(const Scene& scene, const View& view, const FrameSettings& settings,
    const ParallelFor& parallelFor, Processes& processes) = 0;

  /// After render(), with the same scene and view: the parts that surfaces cover of the pixels of
  /// the frame that they share, for samples at `positions` in a pixel, 0..1, at most 32.
  virtual void divideEdges(const Scene& scene, const View& view,
    const std::vector<glm::vec2>& positions, const ParallelFor& parallelFor,
    Silhouettes& result) const = 0;

  /// Of the last frame; times and counts may be of the one before it, if whoever traces learns of
  /// them late. Errors, and what is missing (fewerTexels), are those of the last one.
  virtual const FrameStatistics& statistics() const = 0;

  /// How rasterised surfaces ask for the light of the last frame, where the settings ask for it
  /// (FrameNeeds::lightCode) and the tracer has it: in the place of shadow maps.
  virtual const LightCode& lightCode() const;

  /// What of the last frame's light is sampled, for surfaces that VTK draws; nothing where
  /// lightCode() has it. `current`: the numbers are those of surfaces that lie where they did.
  virtual const ReceiverShares& receiverShares() const;
  /// After render(), with the same scene and view: finds these numbers. `same`: the surfaces lie
  /// where they did. Statistics count it among the frame's.
  virtual void sampleReceivers(
    const Scene&, const View&, const ReceiverPlaces&, bool /* same */, const ParallelFor&)
  {
  }

  /// What VTK is to draw of the last frame, where the settings ask for light code and the tracer
  /// has it: surfaces that frame() does not show.
  virtual const EyeCode& eyeCode() const;

  /// The shadow buffers of the last frame; empty unless FrameSettings::handsOutMaps().
  virtual const std::vector<ShadowMap>& shadowMaps() const = 0;
  /// Where these lie in OpenGL, as Frame::images does: the name of a two-dimensional array of
  /// textures, not filtered. Each layer is a map, of floats: linear depth less ShadowMap::base,
  /// more than 1e30 where nothing lies; and if there are maps of translucent casters, the share of
  /// the light that these take, 0 where nothing lies. 0: they lie in ShadowMap::texels.
  virtual unsigned int mapTexture() const { return 0; }

  /// Frees all layers that are kept for the next frame (FrameStatistics::layerMemory).
  virtual void releaseLayers() = 0;

  /// Frees what lies in the OpenGL context in which render() was called last, and forgets its
  /// frame. That context is current, and may be gone afterwards.
  virtual void releaseGraphicsResources() {}
};

/// The tracer on the processor.
VTKSVOTRACING_EXPORT std::unique_ptr<Tracer> makeCPUTracer();
}

#endif
