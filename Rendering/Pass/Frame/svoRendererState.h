// The state of a pass for one renderer, and the steps of its frames: collect, trace, present.
#ifndef svoRendererState_h
#define svoRendererState_h

#include "svoLightCode.h"
#include "svoMapCode.h"
#include "svoOctreeStore.h"
#include "svoPassStatistics.h"
#include "svoReceiverProps.h"
#include "svoSampleDistance.h"
#include "svoSampledMask.h"
#include "svoSceneCollector.h"
#include "svoShadowMask.h"
#include "svoShadowReceivers.h"
#include "svoSharedCasters.h"
#include "svoSkyTexture.h"
#include "svoTracedBoxes.h"
#include "svoTracer.h"
#include "svoWindowTime.h"
#include "vtkSVOPresenter.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkOpenGLRenderPass;
class vtkProp;
class vtkRenderState;
class vtkRenderer;
class vtkWindow;

namespace svo
{
class RendererState
{
public:
  RendererState(vtkRenderer* renderer, std::unique_ptr<Tracer> tracer);
  ~RendererState();

  vtkRenderer* renderer() const { return this->Renderer; }

  void beginFrame();

  /// Collects its scene from the renderer, whose lights are in place; the last of several times
  /// counts.
  void collect(OctreeStore& store, const StoreOptions& options, CollectSettings settings);

  /// Merges the shadow buffers of the collected scene with other processes'
  /// (Tracer::shareShadows()), or adds their casters to the scene, of `memoryLimit` bytes at most
  /// (SharedCasters). The rest as trace() will be told. A collective call.
  void share(vtkMultiProcessController* controller, int width, int height, double distance,
    FrameSettings settings, std::size_t memoryLimit);

  /// True if there is anything to trace, here or, with shadows to be seen here, elsewhere.
  bool hasSomething() const
  {
    return (this->Collected.current &&
             (!this->Collected.scene.instances.empty() || this->LightsAll)) ||
      this->SharesShadows;
  }

  /// True if the prop is none for the rasteriser: it is shown by what is traced in this frame.
  bool traces(vtkProp* prop) const
  {
    return this->Collected.current && this->Collected.replaced.count(prop) > 0;
  }

  /// Before tracing: the presenter is to write what outer passes expect of the props that it
  /// replaces.
  void joinPasses(const vtkRenderState* state);

  /// Traces the collected scene, `width` by `height` pixels, at a pace that `settings` know of.
  /// Nothing is drawn yet. `refinesAtOnce`: its lights get more samples until refined() says so
  /// of `error`, which is known where it is above 0.
  void trace(int width, int height, const FramePace& pace, FrameSettings settings, double error,
    bool refinesAtOnce);

  /// Of its lights, in what was traced last.
  int samples() const { return this->Trace->statistics().lightSamples; }
  /// What one more for each pixel took when some were added last; 0: nobody knows.
  double secondsOfSample() const { return this->SecondsOfSample; }
  /// True if what was traced last has `most` samples of its lights, or twice as many have changed
  /// it by `error` at most; 0: whatever they have changed.
  bool refined(int most, double error) const
  {
    const FrameStatistics& frame = this->Trace->statistics();
    const bool masked = !this->Trace->lightCode().sampled.empty();
    const double changed = masked ? this->Mask.changed() : frame.lightError;
    return !this->HasPicture || frame.lightSamples == 0 || frame.lightSamples >= most ||
      (error > 0.0 && changed >= 0.0 && changed <= error);
  }

  /// Has the frame's light found for what will be seen of the receivers among these props, which
  /// carry the pass, where that is better than asking when they are drawn. To be called before.
  void findLight(const vtkRenderState& drawn);

  /// True if what has been traced is what the renderer's camera sees now. Passes that show several
  /// directions, as a panorama does, draw the props once for each.
  bool shows(int width, int height) const;

  /// The pace of a frame whose window has `budget` seconds for all of its renderers.
  FramePace choosePace(double budget, double maximum);

  /// The frame's time, its part that does not depend on the number of rays or texels, and that of
  /// shadow maps that are made coarser to save time.
  void measured(double seconds, double fixed, double shadows);

  /// The prop that shows what was traced.
  vtkSVOPresenter* presenter() { return this->Presenter; }

  /// Puts the presenter in the traced props' place. The array is the renderer's own, so its entries
  /// can change for the length of a frame, their number cannot; the caller puts them back.
  void exchange(const vtkRenderState* state, vtkOpenGLRenderPass* pass);

  /// Has the presenter, which is in the renderer's own list, show what was traced.
  void present(vtkOpenGLRenderPass* pass);

  /// Between frames: frees the depth layers and the scene that are kept for the next frame.
  void releaseLayers();

  /// To be called when the frame has been drawn: nothing is traced any more.
  void finish();

  /// A message about the traced frame; empty if all is well.
  const std::string& complaint() const { return this->Complaint; }
  /// True if OpenGL was asked for the picture that trace() has made ready, and makes it.
  bool drawnByOpenGL() const
  {
    return this->Statistics.openGL && this->Trace && !this->Trace->frame().hasPicture();
  }

  /// Of its environment texture; `why` there is none, in a sentence.
  std::shared_ptr<const SkyPicture> skyPicture(std::string& why)
  {
    return this->Sky.of(this->Renderer, why);
  }
  ShadowReceivers& receivers() { return this->Receivers; }
  const CollectedScene& collected() const { return this->Collected; }
  /// Of the frame, since beginFrame().
  PassStatistics& statistics() { return this->Statistics; }
  void releaseGraphicsResources(vtkWindow* window);

private:
  /// Of the renderer's camera; without pixels if there is none to be had.
  View aim(int width, int height, double distance) const;
  void render(const FrameSettings& settings);
  void refine(const std::function<void()>& sample = nullptr);
  void sampleReceivers(bool same);
  std::string lostShadows(const FrameSettings& settings) const;
  void forgetScene();

  vtkWeakPointer<vtkRenderer> Renderer;
  SceneCollector Collector;
  CollectedScene Collected;
  SharedCasters OtherCasters;
  SkyTexture Sky;
  SampleDistance Distance;
  std::shared_ptr<WindowTime> Window; // of the window that it was measured in last
  std::unique_ptr<Tracer> Trace;
  View Eye;               // of the frame
  FrameSettings Settings; // of the frame
  double SecondsOfSample = 0.0;
  double LightError = 0.0; // of the frame; 0: all samples that there may be
  bool RefinesAtOnce = false;
  int AddedSamples = 0; // in the frame, to those before
  bool InFrame = false;
  bool ForgetsScene = false;  // as soon as the frame has ended
  bool SharesShadows = false; // this frame's shadow buffers are those of all processes
  bool LightsAll = false;     // receivers ask what is all around, whatever casts
  bool HasPicture = false;    // the tracer has rendered this frame
  MapCode Maps;
  ShadowMask Mask;
  SampledMask Sampled;
  ReceiverPlaces Places; // that were sampled last
  ReceiverProps Drawn;   // what samples lie on
  TracedBoxes Boxes;
  ShadowReceivers Receivers;
  std::string Complaint;
  PassStatistics Statistics;
  vtkNew<vtkSVOPresenter> Presenter;
  std::vector<vtkSmartPointer<vtkSVONothing>> Nothings;
};
}

#endif
