#include "svoCasterOctrees.h"

#include "svoAbort.h"
#include "svoMeshOctree.h"
#include "vtkPolyDataToSVO.h"

#include "vtkCommand.h"
#include "vtkPolyData.h"

namespace svo
{
CasterOctrees::CasterOctrees(vtkAlgorithm* owner)
  : Owner(owner)
{
  this->Converter->SetAdaptLevel(true);
  this->Converter->SetKeepOctrees(true);
  for (const auto event :
    { vtkCommand::ProgressEvent, vtkCommand::ErrorEvent, vtkCommand::WarningEvent })
  {
    this->Converter->AddObserver(event, this, &CasterOctrees::onEvent);
  }
}

CasterOctrees::~CasterOctrees() = default;

void CasterOctrees::onEvent(vtkObject*, unsigned long event, void* data)
{
  if (event == vtkCommand::ProgressEvent)
  {
    const double done = *static_cast<double*>(data);
    this->Owner->UpdateProgress(this->Begin + done * (this->End - this->Begin));
    this->Converter->SetAbortExecute(isAborted(this->Owner));
  }
  else
  {
    // Without the name of a file and of an object that users know nothing of.
    const std::string text = static_cast<const char*>(data);
    const std::size_t colon = text.find("): ");
    const std::size_t end = text.find_last_not_of("\n ");
    const std::size_t begin = colon == std::string::npos ? 0 : colon + 3;
    this->Problems.push_back(text.substr(begin, end + 1 - begin));
  }
}

Octree CasterOctrees::octreeOf(
  vtkPolyData* mesh, int level, double begin, double end, std::string& problem)
{
  this->Problems.clear();
  this->Begin = begin;
  this->End = end;
  vtkNew<vtkPolyData> copy; // what is upstream must not be executed again
  copy->ShallowCopy(mesh);
  this->Converter->SetMaximumLevel(level);
  this->Converter->SetInputData(copy);
  this->Converter->SetAbortExecute(0);
  this->Converter->Update();
  this->Converter->SetInputData(nullptr);
  Octree octree;
  std::string damage;
  openAttachedOctree(this->Converter->GetOutput(), octree, damage);
  this->Converter->GetOutput()->Initialize();
  problem = this->Problems.empty() ? std::string() : this->Problems.front();
  return octree;
}
}
