#include "vtkSVOSurfaceAlgorithm.h"

#include "svoMeshOctree.h"
#include "svoSourceOctree.h"

#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkTimerLog.h"

//------------------------------------------------------------------------------
vtkPolyData* vtkSVOSurfaceAlgorithm::Begin(vtkInformationVector* outputVector)
{
  this->NumberOfVoxels = 0;
  this->BuildTime = 0.0;
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  output->Initialize();
  return output;
}

//------------------------------------------------------------------------------
void vtkSVOSurfaceAlgorithm::NoteBuilt(
  const svo::SourceOctree& built, double start, vtkPolyData* output)
{
  this->BuildTime = vtkTimerLog::GetUniversalTime() - start;
  this->NumberOfVoxels = static_cast<vtkIdType>(built.voxels);
  if (built.octree && this->WriteStatistics)
  {
    svo::attachStatistics(output, built.octree, this->BuildTime);
  }
}

//------------------------------------------------------------------------------
void vtkSVOSurfaceAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MemoryLimit: " << this->MemoryLimit << " KiB\n";
  os << indent << "MaximumNumberOfQuads: " << this->MaximumNumberOfQuads << "\n";
  os << indent << "WriteStatistics: " << (this->WriteStatistics ? "On\n" : "Off\n");
  os << indent << "NumberOfVoxels: " << this->NumberOfVoxels << "\n";
  os << indent << "BuildTime: " << this->BuildTime << " s\n";
}
