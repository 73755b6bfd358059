// What a pass keeps for its renderers, and their frames that are in progress.
#ifndef svoPassFrames_h
#define svoPassFrames_h

#include "svoEraseIf.h"
#include "svoPassFrame.h"
#include "svoRendererState.h"
#include "svoTracer.h"

#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace svo
{
class PassFrames
{
public:
  using States = std::map<vtkRenderer*, std::shared_ptr<RendererState>>;

  explicit PassFrames(std::function<std::unique_ptr<Tracer>()> makeTracer)
    : MakeTracer(std::move(makeTracer))
  {
  }

  /// The state for a renderer, made when it is first asked for; those of dead renderers are
  /// dropped.
  std::shared_ptr<RendererState> stateOf(vtkRenderer* renderer)
  {
    eraseIf(this->Kept, [](const auto& entry) { return !entry.second->renderer(); });
    std::shared_ptr<RendererState>& found = this->Kept[renderer];
    if (!found)
    {
      found = std::make_shared<RendererState>(renderer, this->MakeTracer());
    }
    return found;
  }

  const States& states() const { return this->Kept; }
  void forget(vtkRenderer* renderer) { this->Kept.erase(renderer); }

  PassFrame& begin(vtkRenderer* renderer)
  {
    this->Frames.push_back(std::make_unique<PassFrame>(this->stateOf(renderer), renderer));
    return *this->Frames.back();
  }

  std::unique_ptr<PassFrame> end(const PassFrame& frame)
  {
    const auto entry = std::find_if(this->Frames.begin(), this->Frames.end(),
      [&frame](const auto& other) { return other.get() == &frame; });
    std::unique_ptr<PassFrame> done = std::move(*entry);
    this->Frames.erase(entry);
    return done;
  }

  bool idle() const { return this->Frames.empty(); }

  /// The windows of those renderers that may have more samples of their lights, up to `most` or
  /// that error; how many samples all have.
  int unrefined(int most, double error, std::set<vtkSmartPointer<vtkRenderWindow>>& windows) const
  {
    int samples = 0;
    windows.clear();
    for (const auto& [key, state] : this->Kept)
    {
      vtkRenderer* renderer = state->renderer();
      if (renderer && renderer->GetRenderWindow() && !state->refined(most, error))
      {
        windows.insert(renderer->GetRenderWindow());
      }
      samples += state->samples();
    }
    return samples;
  }

  /// The frame of a renderer that is in progress; null if there is none.
  PassFrame* of(vtkRenderer* renderer) const
  {
    const auto found = std::find_if(this->Frames.begin(), this->Frames.end(),
      [renderer](const auto& frame) { return frame->renderer == renderer; });
    return found != this->Frames.end() ? found->get() : nullptr;
  }

  /// The state for the renderer of the innermost frame; null between frames.
  RendererState* current() const
  {
    return this->Frames.empty() ? nullptr : this->Frames.back()->state.get();
  }

private:
  std::function<std::unique_ptr<Tracer>()> MakeTracer;
  States Kept;
  std::vector<std::unique_ptr<PassFrame>> Frames; // the innermost last
};
}

#endif
