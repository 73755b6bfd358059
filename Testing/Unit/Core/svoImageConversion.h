// An image of distances from a sphere, and what the conversion filter makes of an image.
#ifndef svoImageConversion_h
#define svoImageConversion_h

#include "svoConversion.h"
#include "vtkImageToSVO.h"

#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <cmath>
#include <string>

namespace svotest
{
constexpr double Centre[3] = { 10.2, -4.1, 3.3 };
constexpr double Radius = 2.0;

/// Distances from a sphere in the middle of an image whose box is about 6 wide.
inline vtkSmartPointer<vtkImageData> distances(bool turned, int extentFrom = 0)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetSpacing(0.1, 0.15, 0.2);
  image->SetExtent(extentFrom, extentFrom + 60, 0, 40, -3, 27);
  if (turned)
  {
    const double c = std::cos(0.5), s = std::sin(0.5);
    image->SetDirectionMatrix(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0);
  }
  double middle[3];
  image->TransformContinuousIndexToPhysicalPoint(extentFrom + 30.0, 20.0, 12.0, middle);
  image->SetOrigin(Centre[0] - middle[0], Centre[1] - middle[1], Centre[2] - middle[2]);
  vtkNew<vtkDoubleArray> values;
  values->SetName("Distance");
  values->SetNumberOfValues(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double x[3];
    image->GetPoint(i, x);
    values->SetValue(i, std::hypot(x[0] - Centre[0], x[1] - Centre[1], x[2] - Centre[2]) - Radius);
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

struct ImageConversion
{
  vtkNew<vtkImageToSVO> filter;
  svo::TestMessages messages{ filter };
  explicit ImageConversion(vtkImageData* image) { this->filter->SetInputData(image); }
  vtkPolyData* output()
  {
    this->filter->Update();
    return this->filter->GetOutput();
  }
  void expectNothing(const std::string& error)
  {
    vtkPolyData* hull = this->output();
    EXPECT_EQ(hull->GetNumberOfCells(), 0);
    EXPECT_FALSE(octreeOf(hull));
    ASSERT_EQ(this->messages.errors.size(), 1u);
    EXPECT_NE(this->messages.all().find(error), std::string::npos) << this->messages.all();
  }
};
}

#endif
