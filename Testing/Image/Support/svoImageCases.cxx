#include "svoImageCases.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace svotest
{
namespace
{
using Field = std::function<double(const double x[3])>;

/// Centred, of a box 2.2 wide along its first axis.
vtkSmartPointer<vtkImageData> imageOf(
  const Field& field, int cells, const double spacing[3], double turn, int type)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  int n[3];
  for (int i = 0; i < 3; ++i)
  {
    n[i] = static_cast<int>(std::lround(cells * spacing[0] / spacing[i]));
  }
  const double s = 2.2 / (n[0] * spacing[0]);
  image->SetSpacing(s * spacing[0], s * spacing[1], s * spacing[2]);
  image->SetExtent(5, n[0] + 5, -2, n[1] - 2, 0, n[2]);
  const double c = std::cos(turn), d = std::sin(turn);
  image->SetDirectionMatrix(c, -d, 0.0, 0.8 * d, 0.8 * c, -0.6, 0.6 * d, 0.6 * c, 0.8);
  if (turn == 0.0)
  {
    image->SetDirectionMatrix(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
  }
  double middle[3];
  image->TransformContinuousIndexToPhysicalPoint(
    5 + 0.5 * n[0], -2 + 0.5 * n[1], 0.5 * n[2], middle);
  image->SetOrigin(-middle[0], -middle[1], -middle[2]);
  image->AllocateScalars(type, 1);
  vtkDataArray* values = image->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double x[3];
    image->GetPoint(i, x);
    values->SetTuple1(i, field(x));
  }
  return image;
}

double ring(const double x[3])
{
  return std::hypot(std::hypot(x[0], x[1]) - 0.65, x[2] - 0.05) - 0.3;
}

double waves(const double x[3])
{
  return std::sin(5.0 * x[0]) + std::sin(4.0 * x[1] + 1.0) + std::cos(6.0 * x[2]) +
    0.8 * std::hypot(x[0], x[1], x[2]) - 0.6;
}

/// Sines of many directions: bends everywhere, up to some cells.
double noise(const double x[3])
{
  std::mt19937 random(7);
  double sum = 0.0;
  for (int i = 0; i < 24; ++i)
  {
    double angle = 0.3;
    for (int k = 0; k < 3; ++k)
    {
      angle += (static_cast<double>(random() % 2001) / 1000.0 - 1.0) * 9.0 * x[k];
    }
    sum += std::sin(angle + static_cast<double>(random() % 1000));
  }
  return sum;
}

constexpr double Even[3] = { 1.0, 1.0, 1.0 };
constexpr double Uneven[3] = { 1.0, 1.4, 2.5 };
}

ImageCase distanceCase()
{
  return { "distances", imageOf(ring, 64, Even, 0.0, VTK_DOUBLE), 0.0 };
}

ImageCase scanCase()
{
  const Field density = [](const double x[3])
  {
    const double r = std::hypot(x[0], x[1], x[2]);
    const double depth = std::min(0.85 - r, std::hypot(x[0] - 0.3, x[1] + 0.4, x[2] - 0.4) - 0.35);
    return std::round(1000.0 / (1.0 + std::exp(-25.0 * depth)));
  };
  return { "scan", imageOf(density, 64, Even, 0.0, VTK_SHORT), 500.0 };
}

std::vector<ImageCase> imageCases()
{
  return { distanceCase(), scanCase(), { "waves", imageOf(waves, 64, Even, 0.0, VTK_DOUBLE), 0.0 },
    { "noise", imageOf(noise, 64, Even, 0.0, VTK_DOUBLE), 1.0 },
    { "uneven spacing", imageOf(ring, 80, Uneven, 0.0, VTK_DOUBLE), 0.0 },
    { "turned axes", imageOf(waves, 64, Even, 0.6, VTK_DOUBLE), 0.0 },
    { "turned, uneven", imageOf(ring, 80, Uneven, 0.6, VTK_DOUBLE), 0.0 } };
}

vtkSmartPointer<vtkImageData> negated(vtkImageData* image)
{
  auto result = vtkSmartPointer<vtkImageData>::New();
  result->DeepCopy(image);
  vtkDataArray* values = result->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    values->SetTuple1(i, -values->GetTuple1(i));
  }
  return result;
}

double longestEdge(vtkImageData* image)
{
  const int* n = image->GetDimensions();
  const double* s = image->GetSpacing();
  return std::max({ (n[0] - 1) * s[0], (n[1] - 1) * s[1], (n[2] - 1) * s[2] });
}

int levelOfSpacing(vtkImageData* image)
{
  const double* s = image->GetSpacing();
  return static_cast<int>(
    std::ceil(std::log2(longestEdge(image) / std::min({ s[0], s[1], s[2] })) - 1e-6));
}

double trilinear(vtkImageData* image, const double at[3])
{
  double index[3];
  image->TransformPhysicalPointToContinuousIndex(at, index);
  const int* e = image->GetExtent();
  int cell[3];
  for (int i = 0; i < 3; ++i)
  {
    if (index[i] < e[2 * i] || index[i] > e[2 * i + 1])
    {
      return std::numeric_limits<double>::quiet_NaN();
    }
    cell[i] = std::min(static_cast<int>(std::floor(index[i])), e[2 * i + 1] - 1);
  }
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    int point[3];
    double weight = 1.0;
    for (int i = 0; i < 3; ++i)
    {
      const int upper = corner >> i & 1;
      point[i] = cell[i] + upper;
      weight *= upper ? index[i] - cell[i] : 1.0 - (index[i] - cell[i]);
    }
    sum += weight * image->GetScalarComponentAsDouble(point[0], point[1], point[2], 0);
  }
  return sum;
}
}
