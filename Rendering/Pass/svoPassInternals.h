// The private state of vtkSVORenderPass, for the files that implement the class.
#ifndef svoPassInternals_h
#define svoPassInternals_h

#include "svoPassFrame.h"
#include "svoRendererState.h"
#include "vtkSVORenderPass.h"

#include "vtkCuller.h"
#include "vtkMultiProcessController.h"
#include "vtkSmartPointer.h"
#include "vtkTimeStamp.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace svo
{
/// The unit of settings of memory.
constexpr std::size_t BytesOfKiB = 1024;

/// A renderer that the pass is attached to.
struct AttachedRenderer
{
  vtkWeakPointer<vtkRenderer> renderer;
  std::vector<unsigned long> observers;
  vtkSmartPointer<vtkCuller> culler; // takes what is traced from what the renderer draws
  bool leaving = false;              // detached in the midst of a frame: as soon as that ends
};
}

struct vtkSVORenderPass::Internals
{
  explicit Internals(const vtkSVORenderPass& pass)
    : self(pass)
  {
  }

  const vtkSVORenderPass& self;
  svo::OctreeStore store;
  std::map<vtkRenderer*, std::shared_ptr<svo::RendererState>> renderers;
  std::map<vtkRenderer*, svo::AttachedRenderer> attached;
  std::vector<std::unique_ptr<svo::PassFrame>> frames; // in progress, the innermost last
  vtkSmartPointer<vtkMultiProcessController> controller;
  svo::PassStatistics statistics;
  std::string castingLights;
  std::vector<std::pair<vtkWeakPointer<vtkProp>, std::string>> reasons; // of the last frame
  std::string shaderSignature; // of the shaders that mappers have built last
  vtkTimeStamp shaderTime;
  std::set<std::string> said; // messages about no object in particular
  bool saidHeadlight = false;
  bool saidMemory = false;
  bool releaseAsked = false; // while a frame was drawn

  /// The state for a renderer, made when it is first asked for; those of dead renderers are
  /// dropped.
  std::shared_ptr<svo::RendererState> stateOf(vtkRenderer* renderer)
  {
    for (auto entry = this->renderers.begin(); entry != this->renderers.end();)
    {
      entry = entry->second->renderer() ? std::next(entry) : this->renderers.erase(entry);
    }
    std::shared_ptr<svo::RendererState>& found = this->renderers[renderer];
    if (!found)
    {
      found = std::make_shared<svo::RendererState>(renderer, this->self.MakeTracer());
    }
    return found;
  }

  /// The state for the renderer of the innermost frame; null between frames.
  svo::RendererState* current() const
  {
    return this->frames.empty() ? nullptr : this->frames.back()->state.get();
  }

  /// The frame of a renderer that is in progress; null if there is none.
  svo::PassFrame* frameOf(vtkRenderer* renderer) const
  {
    const auto found = std::find_if(this->frames.begin(), this->frames.end(),
      [renderer](const auto& frame) { return frame->renderer == renderer; });
    return found != this->frames.end() ? found->get() : nullptr;
  }
};

#endif
