#include "vtkSVOShadowFilter.h"

#include "svoAbort.h"
#include "svoCellSamples.h"
#include "svoMeshOctree.h"
#include "svoMeshTriangles.h"
#include "svoPointSamples.h"
#include "svoShadowShares.h"
#include "vtkPolyDataToSVO.h"

#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkLight.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

vtkStandardNewMacro(vtkSVOShadowFilter);
vtkCxxSetObjectMacro(vtkSVOShadowFilter, MeshMatrix, vtkMatrix4x4);

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

constexpr double BuildShare = 0.3; // of the progress

/// A mesh that casts, and where it stands.
struct CasterMesh
{
  vtkPolyData* mesh;
  glm::dmat4 toWorld;
  svo::ShadowCasters::Own own;
};

glm::dmat4 matrixOf(vtkMatrix4x4* matrix)
{
  glm::dmat4 m(1.0);
  for (int i = 0; matrix && i < 16; ++i)
  {
    m[i % 4][i / 4] = matrix->GetElement(i / 4, i % 4);
  }
  return m;
}

/// True if a matrix takes all points to points, each to one of its own.
bool isPlace(const glm::dmat4& m)
{
  return svo::placesSomething(m) && m[0][3] == 0.0 && m[1][3] == 0.0 && m[2][3] == 0.0 &&
    m[3][3] == 1.0;
}

/// A light as the engine has it; off, and a word in `problem`, where it has no place.
svo::WeightedLight lightOf(vtkLight* source, double weight, std::string& problem)
{
  svo::WeightedLight result;
  svo::Light& light = result.light;
  result.weight = weight;
  double from[3], to[3];
  source->GetTransformedPosition(from);
  source->GetTransformedFocalPoint(to);
  light.position = { from[0], from[1], from[2] };
  const glm::dvec3 axis = glm::dvec3(to[0], to[1], to[2]) - light.position;
  const double length = glm::length(axis);
  light.direction = length > 0.0 ? axis / length : glm::dvec3(0.0);
  light.coneAngle = source->GetConeAngle();
  if (source->GetPositional())
  {
    // VTK draws all cones from 90 degrees on as none.
    light.kind = light.coneAngle < 90.0 ? svo::Light::Kind::Spot : svo::Light::Kind::Point;
  }
  result.on = source->GetSwitch() != 0;
  if (!result.on)
  {
    return result;
  }
  const bool aimed = length > 0.0 && std::isfinite(length);
  const bool placed = std::isfinite(from[0]) && std::isfinite(from[1]) && std::isfinite(from[2]);
  if (!source->LightTypeIsSceneLight())
  {
    problem = "moves with a camera, and there is none here";
  }
  else if (!placed || (!aimed && light.kind != svo::Light::Kind::Point))
  {
    problem = "has no direction: its position and focal point are the same, or not finite";
  }
  else if (!std::isfinite(weight))
  {
    problem = "has a weight that is not finite";
  }
  result.on = problem.empty();
  return result;
}

/// The point normals of a mesh, empty where it has none.
std::vector<glm::dvec3> normalsOf(vtkPolyData* mesh)
{
  vtkDataArray* array = mesh->GetPointData()->GetNormals();
  std::vector<glm::dvec3> normals;
  if (array && array->GetNumberOfComponents() == 3 &&
    array->GetNumberOfTuples() == mesh->GetNumberOfPoints())
  {
    normals.resize(static_cast<std::size_t>(mesh->GetNumberOfPoints()));
    for (std::size_t i = 0; i < normals.size(); ++i)
    {
      array->GetTuple(static_cast<vtkIdType>(i), &normals[i].x);
    }
  }
  return normals;
}
}

class vtkSVOShadowFilter::vtkInternals
{
public:
  struct Weighted
  {
    vtkSmartPointer<vtkLight> light;
    double weight = 1.0;
  };
  std::vector<Weighted> Lights;
  std::map<int, vtkSmartPointer<vtkMatrix4x4>> Matrices; // of casters
  vtkNew<vtkPolyDataToSVO> Converter;                    // keeps the octrees that it builds
  std::vector<std::string> Problems;                     // of the converter
  vtkSVOShadowFilter* Owner = nullptr;
  double BuildBegin = 0.0, BuildEnd = 0.0; // of the progress of one build

  explicit vtkInternals(vtkSVOShadowFilter* owner)
    : Owner(owner)
  {
    this->Converter->SetAdaptLevel(true);
    this->Converter->SetKeepOctrees(true);
    vtkNew<vtkCallbackCommand> listener;
    listener->SetClientData(this);
    listener->SetCallback(
      [](vtkObject*, unsigned long event, void* data, void* call)
      {
        auto* self = static_cast<vtkInternals*>(data);
        if (event == vtkCommand::ProgressEvent)
        {
          self->onProgress(*static_cast<double*>(call));
        }
        else
        {
          self->Problems.emplace_back(static_cast<const char*>(call));
        }
      });
    for (const auto event :
      { vtkCommand::ProgressEvent, vtkCommand::ErrorEvent, vtkCommand::WarningEvent })
    {
      this->Converter->AddObserver(event, listener);
    }
  }

  void onProgress(double done)
  {
    this->Owner->UpdateProgress(this->BuildBegin + done * (this->BuildEnd - this->BuildBegin));
    this->Converter->SetAbortExecute(svo::isAborted(this->Owner));
  }

  /// The octree that a mesh carries, or one that is built; empty if there is none.
  svo::Octree octreeOf(vtkPolyData* mesh, int level)
  {
    vtkNew<vtkPolyData> copy; // what is upstream must not be executed again
    copy->ShallowCopy(mesh);
    this->Problems.clear();
    this->Converter->SetMaximumLevel(level);
    this->Converter->SetInputData(copy);
    this->Converter->SetAbortExecute(0);
    this->Converter->Update();
    this->Converter->SetInputData(nullptr);
    svo::Octree octree;
    std::string ignored;
    svo::openAttachedOctree(this->Converter->GetOutput(), octree, ignored);
    this->Converter->GetOutput()->Initialize();
    return octree;
  }
};

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
int vtkSVOShadowFilter::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  std::set<double> steps;
  double range[2] = { 0.0, 0.0 };
  bool changes = false;
  for (int port = 0; port < 2; ++port)
  {
    for (int i = 0; i < inputVector[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* info = inputVector[port]->GetInformationObject(i);
      if (vtkInformationDoubleVectorKey* key = Pipeline::TIME_STEPS(); info->Has(key))
      {
        steps.insert(info->Get(key), info->Get(key) + info->Length(key));
      }
      if (info->Has(Pipeline::TIME_RANGE()))
      {
        const double* own = info->Get(Pipeline::TIME_RANGE());
        range[0] = changes ? std::min(range[0], own[0]) : own[0];
        range[1] = changes ? std::max(range[1], own[1]) : own[1];
        changes = true;
      }
    }
  }
  vtkInformation* info = outputVector->GetInformationObject(0);
  if (!steps.empty())
  {
    const std::vector<double> all(steps.begin(), steps.end());
    info->Set(Pipeline::TIME_STEPS(), all.data(), static_cast<int>(all.size()));
  }
  if (changes)
  {
    info->Set(Pipeline::TIME_RANGE(), range, 2);
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
  this->Internals->Lights.push_back({ light, 1.0 });
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
  if (!this->GetLight(index))
  {
    vtkErrorMacro("There is no light " << index << " to give a weight to.");
    return;
  }
  auto& weighted = this->Internals->Lights[static_cast<std::size_t>(index)];
  if (weighted.weight != weight)
  {
    weighted.weight = weight;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
double vtkSVOShadowFilter::GetWeight(int index)
{
  if (!this->GetLight(index))
  {
    vtkErrorMacro("There is no light " << index << " that has a weight.");
    return 0.0;
  }
  return this->Internals->Lights[static_cast<std::size_t>(index)].weight;
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
int vtkSVOShadowFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  output->ShallowCopy(input);
  this->BuildTime = this->TraceTime = 0.0;
  this->PrepareLights();
  const glm::dmat4 toWorld = matrixOf(this->MeshMatrix);
  if (!isPlace(toWorld))
  {
    vtkErrorMacro("There are no shadows: the mesh's matrix is not affine, or has no inverse.");
    return 1;
  }

  // Lights, and what is wrong with them.
  std::vector<svo::WeightedLight> lights;
  std::map<std::string, std::string> wrong; // problem to the lights that have it
  for (const auto& weighted : this->Internals->Lights)
  {
    std::string problem;
    lights.push_back(lightOf(weighted.light, weighted.weight, problem));
    if (!problem.empty())
    {
      std::string& who = wrong[problem];
      who += (who.empty() ? "" : ", ") + std::to_string(lights.size() - 1);
    }
  }
  for (const auto& one : wrong)
  {
    vtkWarningMacro(
      "Nothing arrives of light " << one.second << " (counted from 0): it " << one.first << ".");
  }

  const svo::MeshTriangles triangles(input);
  if (!triangles.addressable())
  {
    vtkErrorMacro("There are no shadows: the mesh has more points, cells or triangles than an "
                  "octree can number.");
    return 1;
  }
  const bool byPoint = this->Association == POINT;
  using Own = svo::ShadowCasters::Own;
  std::vector<CasterMesh> meshes;
  if (this->MeshCasts && input->GetNumberOfCells() > 0)
  {
    meshes.push_back({ input, toWorld, byPoint ? Own::Points : Own::Triangles });
  }
  int withoutInverse = 0;
  for (int i = 0; i < inputVector[1]->GetNumberOfInformationObjects(); ++i)
  {
    const glm::dmat4 place = matrixOf(this->GetCasterMatrix(i));
    vtkDataObject* data = vtkDataObject::GetData(inputVector[1], i);
    if (!isPlace(place))
    {
      ++withoutInverse;
    }
    else if (auto* mesh = vtkPolyData::SafeDownCast(data))
    {
      meshes.push_back({ mesh, place, Own::Nothing });
    }
    else if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
    {
      auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
      for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
      {
        if (auto* block = vtkPolyData::SafeDownCast(iterator->GetCurrentDataObject()))
        {
          meshes.push_back({ block, place, Own::Nothing });
        }
      }
    }
  }
  if (withoutInverse > 0)
  {
    vtkWarningMacro(<< withoutInverse
                    << " casters cast nothing: their matrices are not affine, or have no inverse.");
  }

  // Octrees.
  double start = vtkTimerLog::GetUniversalTime();
  svo::ShadowCasters casters;
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    const double count = static_cast<double>(meshes.size());
    this->Internals->BuildBegin = BuildShare * static_cast<double>(i) / count;
    this->Internals->BuildEnd = BuildShare * static_cast<double>(i + 1) / count;
    const svo::Octree octree = this->Internals->octreeOf(meshes[i].mesh, this->MaximumLevel);
    if (svo::isAborted(this))
    {
      return 1;
    }
    if (!octree && !this->Internals->Problems.empty())
    {
      vtkErrorMacro(
        "There are no shadows, as a caster has no octree: " << this->Internals->Problems.front());
      return 1;
    }
    casters.add(octree, meshes[i].toWorld, meshes[i].own);
  }
  this->BuildTime = vtkTimerLog::GetUniversalTime() - start;

  // Arrays: what has no answer stays NaN.
  const vtkIdType count = byPoint ? input->GetNumberOfPoints() : input->GetNumberOfCells();
  const auto components = static_cast<vtkIdType>(lights.size());
  const bool withShadow = this->WriteShadow && components > 0;
  const double needed =
    static_cast<double>(count) * (8.0 + (withShadow ? 4.0 * static_cast<double>(components) : 0.0));
  const auto available = static_cast<double>(svo::availableMemory());
  if (available > 0.0 && needed > available)
  {
    vtkErrorMacro("There are no shadows: the arrays need "
      << needed / 1048576.0 << " MiB, and there are " << available / 1048576.0
      << ". WriteShadowOff() leaves \"Exposure\" only.");
    return 1;
  }
  vtkNew<vtkDoubleArray> exposure;
  exposure->SetName("Exposure");
  exposure->SetNumberOfTuples(count);
  exposure->FillValue(std::numeric_limits<double>::quiet_NaN());
  vtkNew<vtkFloatArray> shadow;
  shadow->SetName("Shadow");
  if (withShadow)
  {
    shadow->SetNumberOfComponents(static_cast<int>(components));
    shadow->SetNumberOfTuples(count);
    std::fill_n(shadow->GetPointer(0), count * components, std::numeric_limits<float>::quiet_NaN());
  }

  svo::ShareOptions options;
  options.twoSided = this->TwoSided;
  options.cosine = this->CosineWeighted;
  options.singleRays = this->SingleRays;
  options.parallelFor = svo::smpParallelFor();
  options.progress = [this](double done)
  {
    this->UpdateProgress(BuildShare + (1.0 - BuildShare) * done);
    return !svo::isAborted(this);
  };
  const svo::ShareArrays arrays{ withShadow ? shadow->GetPointer(0) : nullptr,
    exposure->GetPointer(0) };
  start = vtkTimerLog::GetUniversalTime();
  vtkIdType answered = 0;
  vtkIdType asked = 0;
  bool finished = true;
  if (byPoint)
  {
    const svo::PointSamples samples(triangles.view(), normalsOf(input), toWorld);
    finished = svo::computeShadowShares(samples, casters, lights, options, arrays);
    answered = static_cast<vtkIdType>(samples.pointCount());
    asked = count;
  }
  else
  {
    const svo::CellSamples samples(
      triangles.view(), triangles.cells(), this->SamplesPerCell, toWorld);
    finished = svo::computeShadowShares(samples, casters, lights, options, arrays);
    answered = static_cast<vtkIdType>(samples.cellCount());
    asked = input->GetNumberOfPolys() + input->GetNumberOfStrips();
  }
  this->TraceTime = vtkTimerLog::GetUniversalTime() - start;
  if (!finished)
  {
    return 1;
  }
  if (answered < asked)
  {
    vtkWarningMacro(<< asked - answered << " of " << asked << (byPoint ? " points" : " cells")
                    << (byPoint ? " are not finite"
                                : " have no area, or points that are not finite")
                    << ": they have NaN in the arrays.");
  }
  vtkDataSetAttributes* attributes = byPoint
    ? static_cast<vtkDataSetAttributes*>(output->GetPointData())
    : static_cast<vtkDataSetAttributes*>(output->GetCellData());
  if (withShadow)
  {
    attributes->AddArray(shadow);
  }
  else
  {
    attributes->RemoveArray("Shadow"); // of a filter upstream, for other lights
  }
  attributes->AddArray(exposure);
  return 1;
}

//------------------------------------------------------------------------------
void vtkSVOShadowFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfLights: " << this->GetNumberOfLights() << "\n";
  for (int i = 0; i < this->GetNumberOfLights(); ++i)
  {
    os << indent << "Light " << i << ": " << this->GetLight(i) << ", weight " << this->GetWeight(i)
       << "\n";
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
