// The private state of vtkSVORenderPass, for the files that implement the class.
#ifndef svoPassInternals_h
#define svoPassInternals_h

#include "svoAttachedRenderer.h"
#include "svoIdleCall.h"
#include "svoPassFrames.h"
#include "vtkSVORenderPass.h"

#include "vtkCallbackCommand.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkTimeStamp.h"

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>

namespace svo
{
/// The unit of settings of memory.
constexpr std::size_t BytesOfKiB = 1024;
}

struct vtkSVORenderPass::Internals
{
  explicit Internals(vtkSVORenderPass* pass)
    : frames([pass] { return pass->MakeTracer(); })
  {
    this->attachedEvents->SetClientData(pass);
    this->attachedEvents->SetCallback(
      [](vtkObject* renderer, unsigned long event, void* hearing, void*)
      {
        static_cast<vtkSVORenderPass*>(hearing)->HearAttached(
          static_cast<vtkRenderer*>(renderer), event);
      });
  }

  svo::OctreeStore store;
  svo::PassFrames frames;
  vtkNew<vtkCallbackCommand> attachedEvents;
  std::map<vtkRenderer*, std::unique_ptr<svo::AttachedRenderer>> attached;
  vtkSmartPointer<vtkMultiProcessController> controller;
  svo::PassStatistics statistics;
  std::string shaderSignature; // of the shaders that mappers have built last
  vtkTimeStamp shaderTime;
  std::set<std::string> said; // messages about no object in particular
  bool releaseAsked = false;  // while a frame was drawn
  double refining = 0.0;      // PaceLimits::refine of the frames that are drawn
  svo::IdleCall idle;

  bool severalProcesses() const
  {
    return this->controller && this->controller->GetNumberOfProcesses() > 1;
  }
};

#endif
