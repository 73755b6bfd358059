// An execution of vtkSVOShadowFilter.
#include "vtkSVOShadowFilter.h"

#include "svoAbort.h"
#include "svoCellSamples.h"
#include "svoInstanceTree.h"
#include "svoInverse.h"
#include "svoMeshOctree.h"
#include "svoMeshTriangles.h"
#include "svoPointSamples.h"
#include "svoSceneChanges.h"
#include "svoShadowShares.h"
#include "vtkSVOShadowFilterInternals.h"

#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

constexpr double BuildShare = 0.3; // of the progress

/// A mesh that casts, and where it stands.
struct CasterMesh
{
  vtkPolyData* mesh;
  glm::dmat4 toWorld;
  bool own; // of the samples
};

/// nullptr: the identity.
glm::dmat4 matrixOf(vtkMatrix4x4* matrix)
{
  return matrix ? glm::transpose(glm::make_mat4(matrix->GetData())) : glm::dmat4(1.0);
}

/// True if a matrix takes all points to points, each to one of its own.
bool isPlace(const glm::dmat4& m)
{
  return svo::placesSomething(m) && m[0][3] == 0.0 && m[1][3] == 0.0 && m[2][3] == 0.0 &&
    m[3][3] == 1.0;
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

  std::map<std::string, std::string> wrong;
  const std::vector<svo::WeightedLight> lights =
    svo::weightedLights(this->Internals->Lights, this->CosineWeighted, wrong);
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
  std::vector<CasterMesh> meshes;
  if (this->MeshCasts && input->GetNumberOfCells() > 0)
  {
    meshes.push_back({ input, toWorld, true });
  }
  int withoutInverse = 0;
  for (int i = 0; i < inputVector[1]->GetNumberOfInformationObjects(); ++i)
  {
    const glm::dmat4 place = matrixOf(this->GetCasterMatrix(i));
    if (isPlace(place))
    {
      for (vtkPolyData* mesh :
        vtkCompositeDataSet::GetDataSets<vtkPolyData>(vtkDataObject::GetData(inputVector[1], i)))
      {
        meshes.push_back({ mesh, place, false });
      }
    }
    else
    {
      ++withoutInverse;
    }
  }
  if (withoutInverse > 0)
  {
    vtkWarningMacro(<< withoutInverse
                    << " casters cast nothing: their matrices are not affine, or have no inverse.");
  }

  // Octrees.
  double start = vtkTimerLog::GetUniversalTime();
  svo::Scene scene;
  svo::OwnMesh own;
  own.points = byPoint;
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    const double count = static_cast<double>(meshes.size());
    const double begin = BuildShare * static_cast<double>(i) / count;
    const double end = BuildShare * static_cast<double>(i + 1) / count;
    std::string problem;
    const svo::Octree octree =
      this->Internals->Octrees.octreeOf(meshes[i].mesh, this->MaximumLevel, begin, end, problem);
    if (svo::isAborted(this))
    {
      return 1;
    }
    if (!octree && !problem.empty())
    {
      vtkErrorMacro("There are no shadows, as a caster has no octree: " << problem);
      return 1;
    }
    if (!problem.empty() && !meshes[i].own)
    {
      vtkWarningMacro("Of a caster: " << problem); // of the mesh itself it is said below
    }
    const std::uint32_t index = svo::addCaster(octree, meshes[i].toWorld, scene);
    if (meshes[i].own && index != svo::OwnMesh::None)
    {
      own.instance = index;
      own.error = svo::triangleError(scene.instances[index]);
    }
  }
  svo::ViewedInstances seen; // by nobody
  seen.assign(scene, false);
  svo::InstanceTree tree;
  tree.follow(scene, svo::SceneFollower().follow(scene), svo::smpParallelFor());
  const svo::RayCasters casters(scene, seen, tree.tree());
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
    for (vtkIdType i = 0; i < components; ++i)
    {
      if (const std::string& name = this->Internals->Lights[static_cast<std::size_t>(i)].name;
          !name.empty())
      {
        shadow->SetComponentName(i, name.c_str());
      }
    }
    shadow->SetNumberOfTuples(count);
    std::fill_n(shadow->GetPointer(0), count * components, std::numeric_limits<float>::quiet_NaN());
  }

  const auto progress = [this](double done)
  { return svo::goesOn(this, BuildShare + (1.0 - BuildShare) * done); };
  const svo::ShareOptions options{ this->TwoSided, this->CosineWeighted, this->SingleRays,
    svo::smpParallelFor(), progress };
  std::atomic<bool> faced{ false };
  const svo::ShareArrays arrays{ withShadow ? shadow->GetPointer(0) : nullptr,
    exposure->GetPointer(0), &faced };
  start = vtkTimerLog::GetUniversalTime();
  vtkIdType answered = 0;
  const auto compute = [&](const svo::Samples& samples)
  {
    answered = static_cast<vtkIdType>(samples.placeCount());
    return svo::computeShadowShares(samples, casters, own, lights, options, arrays);
  };
  const vtkIdType asked = byPoint ? count : input->GetNumberOfPolys() + input->GetNumberOfStrips();
  const bool finished = byPoint
    ? compute(svo::PointSamples(triangles.view(), normalsOf(input), toWorld))
    : compute(svo::CellSamples(triangles.view(), triangles.cells(), this->SamplesPerCell, toWorld));
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
  if (!faced && answered > 0 &&
    std::any_of(lights.begin(), lights.end(), [](const auto& light) { return light.on; }))
  {
    vtkWarningMacro("Nothing arrives: no "
      << (byPoint ? "point" : "cell")
      << " faces any of the lights, or lies in the cone of one. The order of a cell's points"
      << (byPoint ? ", or point normals, tell" : " tells")
      << " its outside; TwoSidedOn() asks for both sides.");
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
