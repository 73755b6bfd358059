#include "vtkImageToSVO.h"

#include "svoAbort.h"
#include "svoImageInput.h"
#include "svoImageSource.h"
#include "svoLeafValues.h"
#include "svoSMPParallel.h"
#include "svoSourceOctree.h"

#include "vtkContourValues.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <new>
#include <sstream>
#include <string>

vtkStandardNewMacro(vtkImageToSVO);

namespace
{
/// Colours of bytes stay bytes, all else becomes floats.
vtkSmartPointer<vtkDataArray> makeValues(vtkDataArray* from, vtkIdType count)
{
  const int components = from->GetNumberOfComponents(), type = from->GetDataType();
  const bool colors = type == VTK_UNSIGNED_CHAR && (components == 3 || components == 4);
  auto values = vtkSmartPointer<vtkDataArray>::Take(
    vtkDataArray::CreateDataArray(colors || type == VTK_DOUBLE ? type : VTK_FLOAT));
  values->SetName(from->GetName());
  values->SetNumberOfComponents(components);
  values->CopyComponentNames(from);
  values->SetNumberOfTuples(count);
  return values;
}

/// By the values that the leaves of an octree have in an array of the image. False if it was
/// aborted.
bool colorBy(vtkDataArray* from, const svo::ImageGrid& grid, const svo::SourceOctree& built,
  const svo::BuildOptions& options, vtkPolyData* mesh)
{
  const auto values = makeValues(from, static_cast<vtkIdType>(built.octree.header().voxelCount));
  const int components = values->GetNumberOfComponents();
  const double rounding = values->GetDataType() == VTK_UNSIGNED_CHAR ? 0.5 : 0.0;
  const auto sample = [&](const auto* points)
  {
    return svo::forEachLeaf(built.octree, options.parallelFor, options.progress,
      [&](std::size_t leaf, const glm::dvec3& at)
      {
        glm::ivec3 cell;
        glm::dvec3 in;
        grid.locate(at, cell, in);
        for (int c = 0; c < components; ++c)
        {
          const double value = svo::trilinear(cell, in, rounding,
            [&](int x, int y, int z)
            { return static_cast<double>(points[components * grid.index(x, y, z) + c]); });
          values->SetComponent(static_cast<vtkIdType>(leaf), c, value);
        }
      });
  };
  bool done = true;
  switch (from->GetDataType())
  {
    vtkTemplateMacro(done = sample(static_cast<const VTK_TT*>(from->GetVoidPointer(0))));
  }
  if (done)
  {
    svo::attachLeafValues(mesh, built, values);
  }
  return done;
}
}

//------------------------------------------------------------------------------
vtkImageToSVO::vtkImageToSVO()
{
  this->Contours->SetNumberOfContours(0);
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

vtkImageToSVO::~vtkImageToSVO()
{
  this->SetColorArrayName(nullptr);
}

//------------------------------------------------------------------------------
void vtkImageToSVO::SetValue(int i, double value)
{
  this->Contours->SetValue(i, value);
}

double vtkImageToSVO::GetValue(int i)
{
  return this->Contours->GetValue(i);
}

double* vtkImageToSVO::GetValues()
{
  return this->Contours->GetValues();
}

void vtkImageToSVO::GetValues(double* values)
{
  this->Contours->GetValues(values);
}

void vtkImageToSVO::SetNumberOfContours(int number)
{
  this->Contours->SetNumberOfContours(number);
}

vtkIdType vtkImageToSVO::GetNumberOfContours()
{
  return this->Contours->GetNumberOfContours();
}

void vtkImageToSVO::GenerateValues(int number, double range[2])
{
  this->Contours->GenerateValues(number, range);
}

void vtkImageToSVO::GenerateValues(int number, double first, double last)
{
  this->Contours->GenerateValues(number, first, last);
}

vtkMTimeType vtkImageToSVO::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->Contours->GetMTime());
}

/// The values to look for, each once.
std::vector<double> vtkImageToSVO::Surfaces()
{
  std::vector<double> surfaces(this->GetValues(), this->GetValues() + this->GetNumberOfContours());
  if (surfaces.empty())
  {
    surfaces.push_back(this->Value);
  }
  const auto isNaN = [](double value) { return std::isnan(value); };
  surfaces.erase(std::remove_if(surfaces.begin(), surfaces.end(), isNaN), surfaces.end());
  std::sort(surfaces.begin(), surfaces.end());
  surfaces.erase(std::unique(surfaces.begin(), surfaces.end()), surfaces.end());
  return surfaces;
}

//------------------------------------------------------------------------------
int vtkImageToSVO::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkImageToSVO::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* in = inputVector[0]->GetInformationObject(0);
  vtkInformation* out = outputVector->GetInformationObject(0);
  // Normals at the border of a part are those of the whole: they are asked for at the surface near
  // a voxel, and go with differences of the points beyond.
  constexpr int Ghosts = 2;
  const int ghosts = out->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS());
  if (out->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()) > 1)
  {
    in->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), std::max(ghosts, Ghosts));
  }
  return 1;
}

//------------------------------------------------------------------------------
/// The array that the surface is of. ParaView names none ("") before it has seen the image.
vtkDataArray* vtkImageToSVO::FindScalars(vtkInformationVector** inputVector, vtkImageData* image)
{
  vtkInformation* asked = this->GetInputArrayInformation(0);
  const char* name = asked->Get(vtkDataObject::FIELD_NAME());
  if (name && !*name)
  {
    return image->GetPointData()->GetScalars();
  }
  int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  vtkDataArray* scalars = this->GetInputArrayToProcess(0, inputVector, association);
  return association == vtkDataObject::FIELD_ASSOCIATION_POINTS ? scalars : nullptr;
}

//------------------------------------------------------------------------------
int vtkImageToSVO::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkImageData* image = vtkImageData::GetData(inputVector[0]);
  vtkPolyData* output = this->Begin(outputVector);
  const bool isPart =
    outputVector->GetInformationObject(0)->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()) > 1;
  if (isPart && image->GetNumberOfPoints() == 0)
  {
    return 1; // there are more processes than parts
  }
  const vtkSmartPointer<vtkDataArray> asked = this->FindScalars(inputVector, image);
  if (const char* reason = svo::unfitImage(image, asked))
  {
    vtkErrorMacro("The octree is not built: " << reason << ".");
    return 1;
  }
  const double start = vtkTimerLog::GetUniversalTime();
  int whole[6];
  image->GetExtent(whole);
  if (isPart && inputVector[0]->GetInformationObject(0)->Has(Pipeline::WHOLE_EXTENT()))
  {
    inputVector[0]->GetInformationObject(0)->Get(Pipeline::WHOLE_EXTENT(), whole);
  }
  const svo::SourceOctree built = this->Convert(image, asked, whole, output);
  this->NoteBuilt(built, start, output);
  if (!built.message.empty())
  {
    vtkErrorMacro("The octree is not built: " << built.message << ".");
  }
  else if (built.status == svo::BuildStatus::Built && built.voxels == 0 && !isPart)
  {
    this->WarnOfNothing(image, asked, built.octree.header().voxelSize);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkImageToSVO::WarnOfNothing(vtkImageData* image, vtkDataArray* scalars, double voxel)
{
  const std::vector<double> surfaces = this->Surfaces();
  double range[2];
  scalars->GetFiniteRange(range);
  if (surfaces.empty())
  {
    vtkWarningMacro("No surface was found: the value to look for is not a number.");
  }
  else if (range[0] > range[1])
  {
    vtkWarningMacro("No surface was found: the image has no finite values.");
  }
  else if (std::any_of(surfaces.begin(), surfaces.end(),
             [&](double value) { return range[0] < value && value < range[1]; }) &&
    voxel > svo::boxOfExtent(image, image->GetExtent()).thickness())
  {
    vtkWarningMacro("No surface was found: the image is thinner than a voxel, which has an edge of "
      << voxel << "; choose a higher level, or more even spacings.");
  }
  else
  {
    std::ostringstream values;
    for (const double value : surfaces)
    {
      values << (value != surfaces.front() ? ", " : "") << value;
    }
    vtkWarningMacro("No surface was found: the image does not take the value "
      << values.str() << " between points on both sides of it; its finite values are " << range[0]
      << " to " << range[1] << ".");
  }
}

//------------------------------------------------------------------------------
/// `whole`: the extent that the image is a part of.
svo::SourceOctree vtkImageToSVO::Convert(
  vtkImageData* image, vtkDataArray* asked, const int whole[6], vtkPolyData* output)
{
  constexpr std::size_t Kibi = 1024;
  const svo::ImageBox box = svo::boxOfExtent(image, image->GetExtent());
  svo::BuildOptions options;
  options.leafGeometry = svo::LeafGeometry::Plane;
  options.transform = svo::transformOfImage(image);
  options.modelLow = box.low;
  options.modelHigh = box.high;
  options.level = this->MaximumLevel > 0 ? this->MaximumLevel : svo::levelOfImage(image, whole);
  options.memoryLimit = this->MemoryLimit * Kibi;
  options.parallelFor = svo::smpParallelFor();
  const svo::Cube cube = svo::cubeOfImage(image, whole, options.level);
  vtkDataArray* colors = this->FindColors(image);
  double begun = 0.0, share = colors ? 0.8 : 1.0;
  options.progress = [&](double progress) { return svo::goesOn(this, begun + share * progress); };
  // Front faces look to smaller values, as those of VTK's contours do.
  const svo::CarrierOptions carrier{ static_cast<std::size_t>(this->MaximumNumberOfQuads), true };
  svo::SourceOctree built{ svo::BuildStatus::BadInput, 0, "scalars of this type are not known" };
  try
  {
    // The image's time counts its arrays' and what is blanked. Another value needs no new pyramid.
    const vtkMTimeType time = std::max(image->GetMTime(), asked->GetMTime());
    if (this->PyramidScalars != asked || this->PyramidTime != time)
    {
      this->Pyramid.reset();
      this->PyramidScalars = asked;
      this->PyramidTime = time;
    }
    const vtkSmartPointer<vtkDataArray> scalars = svo::visibleScalars(image, asked);
    const svo::ImageGrid grid = svo::gridOfImage(image);
    const auto convert = [&](const auto* values)
    {
      const svo::ImageField field(grid, values);
      if (!this->Pyramid)
      {
        this->Pyramid = std::make_shared<const svo::ValuePyramid>(grid, field, options.parallelFor);
      }
      const svo::ImageSource source(field, grid, *this->Pyramid, this->Surfaces());
      return svo::buildSourceOctree(source, options, carrier, output, &cube);
    };
    switch (scalars->GetDataType())
    {
      vtkTemplateMacro(built = convert(static_cast<const VTK_TT*>(scalars->GetVoidPointer(0))));
    }
    begun = 0.8;
    share = 0.2;
    if (built.voxels > 0 && colors && !colorBy(colors, grid, built, options, output))
    {
      output->Initialize();
      built = { svo::BuildStatus::Aborted, 0, {} };
    }
  }
  catch (const std::bad_alloc&)
  {
    output->Initialize();
    built = { svo::BuildStatus::TooLarge, 0,
      "there is not enough memory for what has to be known of the image" };
  }
  return built;
}

//------------------------------------------------------------------------------
/// nullptr, and a warning, if there is no array of that name.
vtkDataArray* vtkImageToSVO::FindColors(vtkImageData* image)
{
  const char* wanted = this->ColorArrayName;
  if (!wanted || !*wanted || std::string(wanted) == "None")
  {
    return nullptr;
  }
  vtkDataArray* colors = image->GetPointData()->GetArray(wanted);
  if (!colors || colors->GetNumberOfTuples() != image->GetNumberOfPoints() ||
    !colors->HasStandardMemoryLayout())
  {
    std::string others;
    for (int i = 0; i < image->GetPointData()->GetNumberOfArrays(); ++i)
    {
      const char* name = image->GetPointData()->GetArrayName(i);
      if (name && image->GetPointData()->GetArray(i))
      {
        others += (others.empty() ? "; it has " : ", ") + std::string(name);
      }
    }
    vtkWarningMacro("The surface has no colours: the image has no array of its points named "
      << wanted << others << ".");
    return nullptr;
  }
  return colors;
}

//------------------------------------------------------------------------------
void vtkImageToSVO::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Value: " << this->Value << "\n";
  this->Contours->PrintSelf(os, indent);
  os << indent << "MaximumLevel: " << this->MaximumLevel << "\n";
  os << indent << "ColorArrayName: " << (this->ColorArrayName ? this->ColorArrayName : "(none)")
     << "\n";
}
