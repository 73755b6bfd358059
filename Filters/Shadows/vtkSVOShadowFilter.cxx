#include "vtkSVOShadowFilter.h"

#include "vtkSVOShadowFilterInternals.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"

#include <algorithm>

vtkStandardNewMacro(vtkSVOShadowFilter);
vtkCxxSetObjectMacro(vtkSVOShadowFilter, MeshMatrix, vtkMatrix4x4);

//------------------------------------------------------------------------------
vtkSVOShadowFilter::vtkSVOShadowFilter()
  : Internals(new vtkInternals(this))
{
  this->SetNumberOfInputPorts(2);
}

vtkSVOShadowFilter::~vtkSVOShadowFilter()
{
  this->SetMeshMatrix(nullptr);
}

//------------------------------------------------------------------------------
int vtkSVOShadowFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  if (port == 1)
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
    info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkSVOShadowFilter::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (const auto& weighted : this->Internals->Lights)
  {
    time = std::max(time, weighted.light->GetMTime());
  }
  for (const auto& matrix : this->Internals->Matrices)
  {
    time = std::max(time, matrix.second->GetMTime());
  }
  return this->MeshMatrix ? std::max(time, this->MeshMatrix->GetMTime()) : time;
}

//------------------------------------------------------------------------------
int vtkSVOShadowFilter::AddLight(vtkLight* light)
{
  if (!light)
  {
    vtkErrorMacro("There is no light to add.");
    return -1;
  }
  this->Internals->Lights.push_back({ light, 1.0, 1.0, {} });
  this->Modified();
  return this->GetNumberOfLights() - 1;
}

//------------------------------------------------------------------------------
void vtkSVOShadowFilter::RemoveLight(vtkLight* light)
{
  auto& lights = this->Internals->Lights;
  const auto found = std::find_if(lights.begin(), lights.end(),
    [light](const auto& weighted) { return weighted.light == light; });
  if (found != lights.end())
  {
    lights.erase(found);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkSVOShadowFilter::RemoveAllLights()
{
  if (!this->Internals->Lights.empty())
  {
    this->Internals->Lights.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkSVOShadowFilter::GetNumberOfLights()
{
  return static_cast<int>(this->Internals->Lights.size());
}

//------------------------------------------------------------------------------
vtkLight* vtkSVOShadowFilter::GetLight(int index)
{
  const bool exists = index >= 0 && index < this->GetNumberOfLights();
  return exists ? this->Internals->Lights[static_cast<std::size_t>(index)].light.Get() : nullptr;
}

//------------------------------------------------------------------------------
void vtkSVOShadowFilter::SetWeight(int index, double weight)
{
  this->SetWeights(index, weight, weight);
}

//------------------------------------------------------------------------------
void vtkSVOShadowFilter::SetWeights(int index, double weight, double withCosine)
{
  svo::FilterLight* light = this->Internals->Find(index, "to give a weight to");
  if (light && (light->weight != weight || light->withCosine != withCosine))
  {
    light->weight = weight;
    light->withCosine = withCosine;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
double vtkSVOShadowFilter::GetWeight(int index)
{
  const svo::FilterLight* light = this->Internals->Find(index, "that has a weight");
  return !light ? 0.0 : this->CosineWeighted ? light->withCosine : light->weight;
}

//------------------------------------------------------------------------------
void vtkSVOShadowFilter::SetLightName(int index, const char* name)
{
  svo::FilterLight* light = this->Internals->Find(index, "to give a name to");
  if (light && light->name != (name ? name : ""))
  {
    light->name = name ? name : "";
    this->Modified();
  }
}

//------------------------------------------------------------------------------
const char* vtkSVOShadowFilter::GetLightName(int index)
{
  const svo::FilterLight* light = this->Internals->Find(index, "that has a name");
  return light ? light->name.c_str() : nullptr;
}

//------------------------------------------------------------------------------
const char* vtkSVOShadowFilter::GetAssociationAsString()
{
  return this->Association == POINT ? "Point" : "Cell";
}

//------------------------------------------------------------------------------
void vtkSVOShadowFilter::SetCasterMatrix(int index, vtkMatrix4x4* matrix)
{
  if (index < 0)
  {
    vtkErrorMacro("There is no caster " << index << ".");
    return;
  }
  if (this->GetCasterMatrix(index) == matrix)
  {
    return;
  }
  if (matrix)
  {
    this->Internals->Matrices[index] = matrix;
  }
  else
  {
    this->Internals->Matrices.erase(index);
  }
  this->Modified();
}

//------------------------------------------------------------------------------
vtkMatrix4x4* vtkSVOShadowFilter::GetCasterMatrix(int index)
{
  const auto found = this->Internals->Matrices.find(index);
  return found == this->Internals->Matrices.end() ? nullptr : found->second.Get();
}

//------------------------------------------------------------------------------
void vtkSVOShadowFilter::AddCasterConnection(vtkAlgorithmOutput* port)
{
  this->AddInputConnection(1, port);
}

//------------------------------------------------------------------------------
void vtkSVOShadowFilter::AddCasterData(vtkDataObject* data)
{
  this->AddInputDataObject(1, data);
}

//------------------------------------------------------------------------------
void vtkSVOShadowFilter::RemoveAllCasters()
{
  this->RemoveAllInputConnections(1);
  if (!this->Internals->Matrices.empty())
  {
    this->Internals->Matrices.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkSVOShadowFilter::PrepareLights()
{
  if (this->Internals->Lights.empty())
  {
    vtkWarningMacro("There are no lights, so nothing arrives: AddLight() adds one.");
  }
}

//------------------------------------------------------------------------------
void vtkSVOShadowFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfLights: " << this->GetNumberOfLights() << "\n";
  for (int i = 0; i < this->GetNumberOfLights(); ++i)
  {
    os << indent << "Light " << i << ": " << this->GetLight(i) << ", weight " << this->GetWeight(i)
       << ", name " << this->GetLightName(i) << "\n";
  }
  os << indent << "Association: " << this->GetAssociationAsString() << "\n";
  os << indent << "SamplesPerCell: " << this->SamplesPerCell << "\n";
  os << indent << "TwoSided: " << (this->TwoSided ? "On\n" : "Off\n");
  os << indent << "CosineWeighted: " << (this->CosineWeighted ? "On\n" : "Off\n");
  os << indent << "MeshCasts: " << (this->MeshCasts ? "On\n" : "Off\n");
  os << indent << "WriteShadow: " << (this->WriteShadow ? "On\n" : "Off\n");
  os << indent << "MeshMatrix: " << this->MeshMatrix << "\n";
  for (const auto& matrix : this->Internals->Matrices)
  {
    os << indent << "Matrix of caster " << matrix.first << ": " << matrix.second.Get() << "\n";
  }
  os << indent << "MaximumLevel: " << this->MaximumLevel << "\n";
  os << indent << "SingleRays: " << (this->SingleRays ? "On\n" : "Off\n");
  os << indent << "BuildTime: " << this->BuildTime << " s\n";
  os << indent << "TraceTime: " << this->TraceTime << " s\n";
}
