// What of a vtkImageData the engine has to know: the whole that a process may have a part of, which
// of its cells count, and the level that is right for it.
#ifndef svoImageInput_h
#define svoImageInput_h

#include "svoImageSource.h"
#include "vtkSmartPointer.h"

class vtkDataArray;
class vtkImageData;

namespace svo
{
/// Bounds in the octree's coordinates.
struct ImageBox
{
  glm::dvec3 low, high;
  double extent() const; // along the longest edge
  double thickness() const;
};

/// Why the surface of an image cannot be looked for; nullptr if it can.
const char* unfitImage(vtkImageData* image, vtkDataArray* scalars);

/// The octree's transform. An image with axes of its own (a direction matrix) gets an octree along
/// these: so the surface ends where the image does. Else it is 1.
glm::dmat4 transformOfImage(vtkImageData* image);

/// In the octree's coordinates. Hidden cells (blanked, refined elsewhere, of another process) are
/// those of the image's own array, which is borrowed.
ImageGrid gridOfImage(vtkImageData* image);

/// Of what lies between points of the extent, of the image's spacing.
ImageBox boxOfExtent(vtkImageData* image, const int extent[6]);

/// The octree's cube: voxels no smaller than those of the bounding cube, a whole number of them, or
/// one, to the smallest cells' edge, from the lower corner on. If they were larger than cells, the
/// bounding cube.
Cube cubeOfImage(vtkImageData* image, const int extent[6], int level);

/// The scalars, or, where points are blanked, doubles in which these are NaN.
vtkSmartPointer<vtkDataArray> visibleScalars(vtkImageData* image, vtkDataArray* scalars);

/// The first level whose voxels are no larger than the smallest spacing, but no less than 8. Where
/// spacings are very uneven, voxels of the smallest would be far too many: then two levels beyond
/// the one that has a voxel for each cell along the axis with most cells, or as many as the image
/// is four voxels thick with.
int levelOfImage(vtkImageData* image, const int extent[6]);
}

#endif
