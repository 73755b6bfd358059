#include "svoImageInput.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

namespace svo
{
namespace
{
/// Steps of a point's index -> local coordinates.
glm::dmat3 stepsOf(vtkImageData* image)
{
  return glm::dmat3(glm::transpose(glm::make_mat4(image->GetIndexToPhysicalMatrix()->GetData())));
}

bool isTurned(vtkImageData* image)
{
  return !image->GetDirectionMatrix()->IsIdentity();
}
}

double ImageBox::extent() const
{
  const glm::dvec3 size = this->high - this->low;
  return std::max({ size.x, size.y, size.z });
}

double ImageBox::thickness() const
{
  const glm::dvec3 size = this->high - this->low;
  return std::min({ size.x, size.y, size.z });
}

const char* unfitImage(vtkImageData* image, vtkDataArray* scalars)
{
  const int* n = image->GetDimensions();
  if (image->GetNumberOfPoints() == 0)
  {
    return "the image is empty";
  }
  if (!scalars)
  {
    return image->GetCellData()->GetNumberOfTuples() > 0
      ? "the image has no such point scalars; make some of its cell data by vtkCellDataToPointData"
      : "the image has no such point scalars";
  }
  if (scalars->GetNumberOfComponents() != 1)
  {
    return "the scalars have more than one component; choose one by vtkImageExtractComponents, or "
           "make one of them by vtkImageLuminance or vtkImageMagnitude";
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
  const glm::dmat3 steps = stepsOf(image);
  const double volume = std::abs(glm::determinant(steps));
  const ImageBox box = boxOfExtent(image, image->GetExtent());
  const glm::dvec3 origin = glm::make_vec3(image->GetOrigin());
  if (!std::isfinite(volume) || !std::isfinite(origin.x + origin.y + origin.z) ||
    !std::isfinite(box.extent()))
  {
    return "the image's origin, spacing or direction matrix is not finite";
  }
  const double x = glm::length(steps[0]), y = glm::length(steps[1]), z = glm::length(steps[2]);
  if (!(volume > 1e-12 * (x * y * z)))
  {
    return "the image is flat: its spacing, or its direction matrix, has no inverse";
  }
  const glm::dvec3 far =
    glm::max(glm::max(glm::abs(box.low), glm::abs(box.high)), glm::abs(origin));
  const double resolved =
    8.0 * std::numeric_limits<double>::epsilon() * std::max({ far.x, far.y, far.z });
  return std::min({ x, y, z }) > resolved
    ? nullptr
    : "the image's spacing is too small to tell points apart so far from the origin";
}

glm::dmat4 transformOfImage(vtkImageData* image)
{
  if (!isTurned(image))
  {
    return glm::dmat4(1.0);
  }
  glm::dmat4 transform(glm::transpose(glm::make_mat3(image->GetDirectionMatrix()->GetData())));
  transform[3] = glm::dvec4(glm::make_vec3(image->GetOrigin()), 1.0);
  return transform;
}

ImageGrid gridOfImage(vtkImageData* image)
{
  ImageGrid grid;
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
  if (vtkUnsignedCharArray* marks = image->GetCellGhostArray())
  {
    grid.cellMarks = marks->GetPointer(0);
    grid.hiddenMarks = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::REFINEDCELL |
      vtkDataSetAttributes::HIDDENCELL;
  }
  return grid;
}

ImageBox boxOfExtent(vtkImageData* image, const int extent[6])
{
  ImageBox box;
  for (int i = 0; i < 3; ++i)
  {
    const double origin = isTurned(image) ? 0.0 : image->GetOrigin()[i];
    const double first = origin + extent[2 * i] * image->GetSpacing()[i];
    const double last = origin + extent[2 * i + 1] * image->GetSpacing()[i];
    box.low[i] = std::min(first, last);
    box.high[i] = std::max(first, last);
  }
  return box;
}

Cube cubeOfImage(vtkImageData* image, const int extent[6], int level)
{
  const ImageBox box = boxOfExtent(image, extent);
  const double* spacing = image->GetSpacing();
  const double least =
    std::min({ std::abs(spacing[0]), std::abs(spacing[1]), std::abs(spacing[2]) });
  const double inCell = std::floor(std::ldexp(least / box.extent(), level) * (1.0 + 1e-9));
  const Cube cube = boundingCube(box.low, box.high, level);
  const double edge = std::ldexp(least / inCell, level);
  // Far from the origin the bounding cube is larger, for points to be told apart.
  const bool resolved = cube.edge <= 1.01 * box.extent();
  return inCell >= 1.0 && resolved ? Cube{ box.low, edge } : cube;
}

vtkSmartPointer<vtkDataArray> visibleScalars(vtkImageData* image, vtkDataArray* scalars)
{
  if (!image->HasAnyBlankPoints())
  {
    return scalars;
  }
  vtkUnsignedCharArray* marks = image->GetPointGhostArray();
  const vtkIdType count = scalars->GetNumberOfTuples();
  const auto visible = vtkSmartPointer<vtkDoubleArray>::New();
  visible->SetName(scalars->GetName());
  visible->SetNumberOfValues(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const bool hidden = (marks->GetValue(i) & vtkDataSetAttributes::HIDDENPOINT) != 0;
    visible->SetValue(
      i, hidden ? std::numeric_limits<double>::quiet_NaN() : scalars->GetComponent(i, 0));
  }
  return visible;
}

int levelOfImage(vtkImageData* image, const int extent[6])
{
  constexpr int Least = 8; // what looks like a surface in a window
  constexpr int MostBeyond = 2;
  const double* spacing = image->GetSpacing();
  const double least =
    std::min({ std::abs(spacing[0]), std::abs(spacing[1]), std::abs(spacing[2]) });
  const int most =
    std::max({ extent[1] - extent[0], extent[3] - extent[2], extent[5] - extent[4] });
  const auto levelFor = [](double cells)
  { return static_cast<int>(std::ceil(std::log2(std::max(cells * (1.0 - 1e-9), 1.0)))); };
  const ImageBox box = boxOfExtent(image, extent);
  const int fine = levelFor(std::min(box.extent() / least, 1e9));
  const int thick = levelFor(std::min(4.0 * box.extent() / box.thickness(), 1e9));
  const int enough = std::min(fine, std::max(levelFor(most) + MostBeyond, thick));
  return std::min(std::max(enough, Least), MaximumLevel);
}
}
