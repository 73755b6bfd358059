// Images with isosurfaces, about 2 wide and around the origin, and their trilinear field.
#ifndef svoImageCases_h
#define svoImageCases_h

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

namespace svotest
{
struct ImageCase
{
  std::string name;
  vtkSmartPointer<vtkImageData> image; // active scalars of type double, or short of a scan
  double value;
};

/// Distances from a ring; larger outside.
ImageCase distanceCase();
/// Densities of a ball with a hollow, as a scan has them: larger inside, in whole numbers.
ImageCase scanCase();
/// These, waves, smooth noise, spacings that differ, and axes that are turned.
std::vector<ImageCase> imageCases();

/// The same with the sign of all values changed.
vtkSmartPointer<vtkImageData> negated(vtkImageData* image);

/// The first level at which 2^level voxels along the image's longest edge are no longer than its
/// least spacing.
int levelOfSpacing(vtkImageData* image);
double longestEdge(vtkImageData* image);

/// The field between the points; NaN outside of the image. Plainly, from the definition.
double trilinear(vtkImageData* image, const double at[3]);
}

#endif
