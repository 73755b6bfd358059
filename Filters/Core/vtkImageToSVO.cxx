#include "vtkImageToSVO.h"

#include "svoAbort.h"
#include "svoImageSource.h"
#include "svoLeafValues.h"
#include "svoSMPParallel.h"
#include "svoSourceOctree.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix3x3.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <new>
#include <string>

vtkStandardNewMacro(vtkImageToSVO);

namespace
{
/// Why an image has no surface to convert; nullptr if it may have one.
const char* unfit(vtkImageData* image, vtkDataArray* scalars)
{
  const int* n = image->GetDimensions();
  if (!scalars)
  {
    return "the image has no such point scalars";
  }
  if (scalars->GetNumberOfComponents() != 1)
  {
    return "the scalars have more than one component";
  }
  if (n[0] < 2 || n[1] < 2 || n[2] < 2)
  {
    return "the image has fewer than two points along an axis";
  }
  if (scalars->GetNumberOfTuples() != image->GetNumberOfPoints() ||
    !scalars->HasStandardMemoryLayout())
  {
    return "the scalars are not one for each point, in one block of memory";
  }
  return nullptr;
}

bool isTurned(vtkImageData* image)
{
  return !image->GetDirectionMatrix()->IsIdentity();
}

/// An image with axes of its own gets an octree along these: its cells are those of no other one,
/// and the surface ends where the image does.
glm::dmat4 frameOf(vtkImageData* image)
{
  glm::dmat4 frame(1.0);
  if (isTurned(image))
  {
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 3; ++column)
      {
        frame[column][row] = image->GetDirectionMatrix()->GetElement(row, column);
      }
      frame[3][row] = image->GetOrigin()[row];
    }
  }
  return frame;
}

/// In the frame of the octree.
svo::ImageGrid gridOf(vtkImageData* image)
{
  svo::ImageGrid grid;
  const int* extent = image->GetExtent();
  const int* n = image->GetDimensions();
  grid.points = { n[0], n[1], n[2] };
  grid.toIndex = glm::dmat4(1.0);
  for (int i = 0; i < 3; ++i)
  {
    const double origin = isTurned(image) ? 0.0 : image->GetOrigin()[i];
    grid.toIndex[i][i] = 1.0 / image->GetSpacing()[i];
    grid.toIndex[3][i] = -origin / image->GetSpacing()[i] - extent[2 * i];
  }
  return grid;
}

/// Of the image's points, in the frame of the octree.
void boundsOf(vtkImageData* image, glm::dvec3& low, glm::dvec3& high)
{
  const int* extent = image->GetExtent();
  for (int i = 0; i < 3; ++i)
  {
    const double origin = isTurned(image) ? 0.0 : image->GetOrigin()[i];
    const double first = origin + extent[2 * i] * image->GetSpacing()[i];
    const double last = origin + extent[2 * i + 1] * image->GetSpacing()[i];
    low[i] = std::min(first, last);
    high[i] = std::max(first, last);
  }
}

/// The level whose voxels are as small as the image's smallest spacing.
int levelOf(vtkImageData* image, const glm::dvec3& size)
{
  const double* spacing = image->GetSpacing();
  const double least =
    std::min({ std::abs(spacing[0]), std::abs(spacing[1]), std::abs(spacing[2]) });
  const double cells = std::max({ size.x, size.y, size.z }) / least;
  return cells >= 2.0 && std::isfinite(cells)
    ? std::min(static_cast<int>(std::ceil(std::log2(cells * (1.0 - 1e-9)))), svo::MaximumLevel)
    : 1;
}

/// The values that the leaves of an octree have in an array of the image.
template <class T>
bool sample(const T* from, const svo::ImageGrid& grid, const svo::Octree& octree,
  const svo::BuildOptions& options, vtkDataArray* values)
{
  const int components = values->GetNumberOfComponents();
  const double rounding = values->GetDataType() == VTK_UNSIGNED_CHAR ? 0.5 : 0.0;
  return svo::forEachLeaf(octree, options.parallelFor, options.progress,
    [&](std::size_t leaf, const glm::dvec3& at)
    {
      glm::ivec3 cell;
      glm::dvec3 in;
      grid.locate(at, cell, in);
      for (int c = 0; c < components; ++c)
      {
        const double value = svo::trilinear(cell, in, rounding,
          [&](int x, int y, int z)
          { return static_cast<double>(from[components * grid.index(x, y, z) + c]); });
        values->SetComponent(static_cast<vtkIdType>(leaf), c, value);
      }
    });
}

bool isName(const char* name)
{
  return name && *name && std::string(name) != "None";
}

/// Colours of bytes stay bytes, all else becomes floats.
vtkSmartPointer<vtkDataArray> makeValues(vtkDataArray* from, vtkIdType count)
{
  const int components = from->GetNumberOfComponents(), type = from->GetDataType();
  const bool colors = type == VTK_UNSIGNED_CHAR && (components == 3 || components == 4);
  auto values = vtkSmartPointer<vtkDataArray>::Take(
    vtkDataArray::CreateDataArray(colors || type == VTK_DOUBLE ? type : VTK_FLOAT));
  values->SetName(from->GetName());
  values->SetNumberOfComponents(components);
  for (int c = 0; c < components && from->HasAComponentName(); ++c)
  {
    values->SetComponentName(c, from->GetComponentName(c));
  }
  values->SetNumberOfTuples(count);
  return values;
}

/// False if it was aborted.
bool colorBy(vtkDataArray* from, const svo::ImageGrid& grid, const svo::Octree& octree,
  const svo::BuildOptions& options, vtkPolyData* hull)
{
  const auto values = makeValues(from, static_cast<vtkIdType>(octree.header().voxelCount));
  bool done = true;
  switch (from->GetDataType())
  {
    vtkTemplateMacro(done = sample(static_cast<const VTK_TT*>(from->GetVoidPointer(0)), grid,
                       octree, options, values.Get()));
  }
  if (done)
  {
    svo::attachLeafValues(hull, octree, values);
  }
  return done;
}

template <class T>
svo::SourceOctree convert(const T* values, const svo::ImageGrid& grid, double value,
  const svo::BuildOptions& options, vtkPolyData* hull)
{
  const svo::ImageField<T> field(grid, values);
  const svo::ValuePyramid pyramid(grid, field, options.parallelFor);
  const svo::ImageSource source(field, grid, pyramid, value);
  return svo::buildSourceOctree(source, options, hull);
}
}

//------------------------------------------------------------------------------
vtkImageToSVO::vtkImageToSVO()
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

vtkImageToSVO::~vtkImageToSVO()
{
  this->SetColorArrayName(nullptr);
}

//------------------------------------------------------------------------------
int vtkImageToSVO::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkImageToSVO::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->NumberOfVoxels = 0;
  this->BuildTime = 0.0;
  vtkImageData* image = vtkImageData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  output->Initialize();
  int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  vtkDataArray* scalars = this->GetInputArrayToProcess(0, inputVector, association);
  if (association != vtkDataObject::FIELD_ASSOCIATION_POINTS)
  {
    scalars = nullptr;
  }
  if (const char* reason = unfit(image, scalars))
  {
    vtkErrorMacro("The octree is not built: " << reason << ".");
    return 1;
  }
  constexpr std::size_t Kibi = 1024;
  svo::BuildOptions options;
  options.leafGeometry = svo::LeafGeometry::Plane;
  options.frame = frameOf(image);
  boundsOf(image, options.modelLow, options.modelHigh);
  options.level = this->MaximumLevel > 0 ? this->MaximumLevel
                                         : levelOf(image, options.modelHigh - options.modelLow);
  options.memoryLimit = this->MemoryLimit * Kibi;
  options.parallelFor = svo::smpParallelFor();
  vtkDataArray* colors =
    isName(this->ColorArrayName) ? image->GetPointData()->GetArray(this->ColorArrayName) : nullptr;
  const bool unfitColors = colors &&
    (colors->GetNumberOfTuples() != image->GetNumberOfPoints() ||
      !colors->HasStandardMemoryLayout());
  colors = unfitColors ? nullptr : colors;
  double begun = 0.0, share = colors ? 0.8 : 1.0;
  options.progress = [&](double progress)
  {
    this->UpdateProgress(begun + share * progress);
    return !svo::isAborted(this);
  };
  svo::SourceOctree built{ svo::BuildStatus::BadInput, 0, "scalars of this type are not known" };
  const double start = vtkTimerLog::GetUniversalTime();
  try
  {
    switch (scalars->GetDataType())
    {
      vtkTemplateMacro(built = convert(static_cast<const VTK_TT*>(scalars->GetVoidPointer(0)),
                         gridOf(image), this->Value, options, output));
    }
    if (built.voxels > 0 && colors)
    {
      begun = 0.8;
      share = 0.2;
      if (!colorBy(colors, gridOf(image), built.octree, options, output))
      {
        output->Initialize();
        built.voxels = 0;
        built.status = svo::BuildStatus::Aborted;
      }
    }
  }
  catch (const std::bad_alloc&)
  {
    output->Initialize();
    built.voxels = 0;
    built.message = "there is not enough memory for what has to be known of the image";
  }
  this->BuildTime = vtkTimerLog::GetUniversalTime() - start;
  this->NumberOfVoxels = static_cast<vtkIdType>(built.voxels);
  if (!built.message.empty())
  {
    vtkErrorMacro("The octree is not built: " << built.message << ".");
  }
  else if (built.status == svo::BuildStatus::Built && built.voxels == 0)
  {
    vtkWarningMacro(
      "No surface was found: the image does not take the value " << this->Value << ".");
  }
  if (built.voxels > 0 && !colors && isName(this->ColorArrayName))
  {
    vtkWarningMacro("The surface has no colours: the image has no array of its points named "
      << this->ColorArrayName << ".");
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkImageToSVO::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Value: " << this->Value << "\n";
  os << indent << "MaximumLevel: " << this->MaximumLevel << "\n";
  os << indent << "ColorArrayName: " << (this->ColorArrayName ? this->ColorArrayName : "(none)")
     << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << " KiB\n";
  os << indent << "NumberOfVoxels: " << this->NumberOfVoxels << "\n";
  os << indent << "BuildTime: " << this->BuildTime << " s\n";
}
