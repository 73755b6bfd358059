// What vtkSVORenderPass keeps, for the files that it is made of.
#ifndef svoPassInternals_h
#define svoPassInternals_h

#include "svoPassRenderer.h"
#include "vtkSVORenderPass.h"

#include "vtkMultiProcessController.h"
#include "vtkSmartPointer.h"
#include "vtkTimeStamp.h"
#include "vtkWeakPointer.h"

#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace svo
{
/// A renderer that the pass is attached to.
struct AttachedRenderer
{
  vtkWeakPointer<vtkRenderer> renderer;
  std::vector<unsigned long> observers;
  std::vector<vtkProp*> props; // those that carry the pass while a frame is drawn
};
}

struct vtkSVORenderPass::Internals
{
  svo::OctreeStore store;
  std::map<vtkRenderer*, std::unique_ptr<svo::PassRenderer>> renderers;
  std::map<vtkRenderer*, svo::AttachedRenderer> attached;
  svo::PassRenderer* current = nullptr; // while its frame is drawn
  vtkSmartPointer<vtkMultiProcessController> controller;
  svo::FrameSettings settings; // of the current frame
  double sampleDistance = 1.0; // pixels, likewise
  bool traced = false;         // the current frame is, where the pass is attached
  svo::PassStatistics statistics;
  std::string castingLights;
  std::string shaderSignature; // of the shaders that mappers have built last
  vtkTimeStamp shaderTime;
  std::set<std::string> said; // about traced frames
  bool saidHeadlight = false;
  bool saidOpenGL = false;

  static svo::FrameSettings settingsOf(const vtkSVORenderPass& pass);

  svo::PassRenderer& of(vtkRenderer* renderer)
  {
    for (auto entry = this->renderers.begin(); entry != this->renderers.end();)
    {
      entry = entry->second->renderer() ? std::next(entry) : this->renderers.erase(entry);
    }
    std::unique_ptr<svo::PassRenderer>& found = this->renderers[renderer];
    if (!found)
    {
      found = std::make_unique<svo::PassRenderer>(renderer);
    }
    return *found;
  }
};

#endif
