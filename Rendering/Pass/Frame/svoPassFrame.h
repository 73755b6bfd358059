// A frame of a pass, from its collection to its end.
#ifndef svoPassFrame_h
#define svoPassFrame_h

#include "svoRendererState.h"

#include "vtkLight.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkProp.h"
#include "vtkRenderPass.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace svo
{
/// What users are told of shadows that are missing; empty: nothing.
struct ShadowWords
{
  std::string onlyHeadlights, nothingCasts, nothingReceives, clipped;
};

/// How an interactive frame may save time.
struct PaceLimits
{
  bool adjust = false;       // rays and texels of shadow maps may be further apart,
  double maximum = 1.0;      // by at most so many pixels of the window
  double detail = 0.0;       // pixels of the window of instances that may be left out
  double refine = 0.0;       // lights get more samples than the last frame shows, so many seconds;
                             // 0: they do not; infinite: twice as many
  double lightError = 0.0;   // the error at which that ends
  bool refinesLater = false; // there is somebody who asks for that
};

/// How a still frame comes to all samples of its lights.
enum class Sampling
{
  AtOnce,
  Begun, // in steps, between which nothing is borrowed from the scene
  InSteps,
  Ended // by an observer
};

/// A frame owns what it needs: between its beginning and its end pipelines run, events are invoked,
/// and observers may drop the pass, detach it, remove actors, finalize the window or draw another
/// one with the same pass, whose frame then lies within this one.
struct PassFrame
{
  PassFrame(std::shared_ptr<RendererState> rendererState, vtkRenderer* drawn)
    : state(std::move(rendererState))
    , renderer(drawn)
    , props(propsOf(drawn))
    , receivingState(drawn)
    , context(stateOf(windowOf(drawn)))
  {
  }

  /// False if the window was finalized, or taken away, since the frame was begun.
  bool canDraw() const
  {
    return this->context && stateOf(windowOf(this->renderer)) == this->context;
  }

  /// Opens the window again if it was finalized, as its next frame would: VTK goes on with this one
  /// in any case, and aborts without. False if there is no window.
  bool reopen()
  {
    vtkOpenGLRenderWindow* window = windowOf(this->renderer);
    if (window && !this->canDraw())
    {
      window->Start();
    }
    this->context = stateOf(window);
    this->receiving.clear(); // others may receive
    return window != nullptr;
  }

  /// Those that carry the pass while the frame is drawn: what shadows fall on. Others may hand it
  /// on to whatever they consist of, as grids of axes do to their labels.
  const vtkRenderState& receivers()
  {
    if (this->receiving.empty())
    {
      const std::set<vtkProp*>& wanted = this->state->collected().receivers;
      std::copy_if(this->props.begin(), this->props.end(), std::back_inserter(this->receiving),
        [&wanted](vtkProp* prop) { return wanted.count(prop) > 0; });
    }
    this->receivingState.SetPropArrayAndCount(
      this->receiving.data(), static_cast<int>(this->receiving.size()));
    return this->receivingState;
  }

  /// True if VTK asks for interaction rather than for a picture to keep.
  bool interactive() const;

  /// Whether the window's frame is to wait for no more builds; null: always. Its observers, who may
  /// disturb the frame, are asked only with `ask`; `heard` says that others hear of the builds.
  std::function<bool()> abort(bool ask, bool heard, bool& disturbed) const;

  /// Has users told, each thing once, of which `said` has those that they have been.
  void tellOnce(const std::string& text, std::set<std::string>& said);
  void tellOfShadows(const ShadowWords& words, std::set<std::string>& said);

  /// Says how the frame is to be traced.
  void decide(const FrameSettings& asked, const PaceLimits& limits);

  void trace(int width, int height);

  /// Until lightNothingMore() there is a black light: without any VTK's shaders do not know where
  /// surfaces lie.
  void lightNothing();
  void lightNothingMore();

  const std::shared_ptr<RendererState> state;
  vtkRenderer* const renderer;
  /// VTK's renderer has an array of them and does not own them.
  const std::vector<vtkSmartPointer<vtkProp>> props;
  FrameSettings settings;
  FramePace pace;
  Sampling sampling = Sampling::AtOnce;
  double lightError = 0.0;    // PaceLimits
  bool refinesAtOnce = false; // until then, or to all samples
  bool traced = false;
  std::vector<std::string> messages; // said when the frame is done

  // Where the pass is attached:
  vtkSmartPointer<vtkRenderPass> pass; // until the frame ends
  bool shadowed = false;               // receivers() carry the pass

private:
  void decideSamples(const PaceLimits& limits);
  static vtkOpenGLRenderWindow* windowOf(vtkRenderer* renderer)
  {
    return vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  }
  /// The OpenGL state that a window has until it is finalized.
  static vtkOpenGLState* stateOf(vtkOpenGLRenderWindow* window)
  {
    return window ? window->GetState() : nullptr;
  }

  vtkSmartPointer<vtkLight> blackLight;
  std::vector<vtkProp*> receiving;
  vtkRenderState receivingState;
  vtkSmartPointer<vtkOpenGLState> context; // kept, so that no other comes into its place
};
}

#endif
