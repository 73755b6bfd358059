/**
 * @class vtkImageToSVO
 * @brief converts an isosurface of an image into a sparse voxel octree, without triangles
 *
 * The surface is where the point scalars of a three-dimensional image take a value, or one of
 * several: those of the array chosen with SetInputArrayToProcess(), by default the active ones. The
 * image is trilinear between its points; spacing, origin and direction matrix count. Each voxel
 * that the surface touches keeps a plane.
 *
 * Another array of the image, or the same, can colour the surface, see SetColorArrayName().
 *
 * The output is a contour of the voxels' planes that carries the octree in its field data, as that
 * of vtkImplicitFunctionToSVO is; its front faces look to smaller values, as those of VTK's
 * contours. What cannot be converted leads to one message and an output without cells: no scalars,
 * more than one component, an image with fewer than two points along an axis, a spacing or
 * direction matrix without an inverse, an octree that needs more memory than there is (errors), a
 * value that the image does not take (warning). Points whose values are not finite, and blanked
 * points, have no surface near them, blanked cells none in them. The build reports progress and can
 * be aborted.
 *
 * Of an image that is spread over processes each converts its part, with voxels of the whole, so
 * that the parts fit together. A part without any surface is no reason for a warning.
 *
 * @sa vtkImplicitFunctionToSVO vtkPolyDataToSVO vtkFlyingEdges3D
 */
#ifndef vtkImageToSVO_h
#define vtkImageToSVO_h

#include "vtkNew.h"           // for the values
#include "vtkSVOCoreModule.h" // for the export macro
#include "vtkSVOSurfaceAlgorithm.h"

#include <memory> // for what is kept of an image
#include <vector>

class vtkContourValues;
class vtkDataArray;
class vtkImageData;

namespace svo
{
struct SourceOctree;
class ValuePyramid;
}

class VTKSVOCORE_EXPORT vtkImageToSVO : public vtkSVOSurfaceAlgorithm
{
public:
  static vtkImageToSVO* New();
  vtkTypeMacro(vtkImageToSVO, vtkSVOSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  //@{
  /**
   * The value that the scalars take on the surface, unless there is a list of values; default 0.
   */
  vtkSetMacro(Value, double);
  vtkGetMacro(Value, double);
  //@}

  //@{
  /**
   * A list of values instead of the one above, with the names of VTK's contour filters; default
   * none. The octree has the surfaces of all of them. Where those of two pass through a voxel it
   * has the one that is nearer to its middle. To tell them apart colour by the scalars themselves.
   */
  void SetValue(int i, double value);
  double GetValue(int i);
  double* GetValues() VTK_SIZEHINT(GetNumberOfContours());
  void GetValues(double* values);
  void SetNumberOfContours(int number);
  vtkIdType GetNumberOfContours();
  void GenerateValues(int number, double range[2]);
  void GenerateValues(int number, double first, double last);
  //@}

  vtkMTimeType GetMTime() override;

  //@{
  /**
   * Depth of the octree: up to 2^level voxels along the image's longest edge, as many as make the
   * smallest spacing a whole number of voxels. 0 to 20, values outside are clamped. 0 (default):
   * the first level whose voxels are no larger than the image's smallest spacing; but at least 8,
   * which looks like a surface, and about 2 beyond the one with a voxel for each cell along the
   * axis with most cells, where spacings are very uneven.
   */
  vtkSetClampMacro(MaximumLevel, int, 0, 20);
  vtkGetMacro(MaximumLevel, int);
  //@}

  //@{
  /**
   * Name of an array of the image's points, of any number of components, that the surface is to be
   * coloured by; default none. Each voxel keeps its value at the surface: the output has field data
   * of that name with a tuple for each voxel, and cell data of the same name, so that mappers can
   * be told to colour by it: vtkSVORenderPass shows the voxels' values, VTK's rasteriser means of
   * the voxels that a quad joins. Unsigned bytes of 3 or 4 components stay colours, other integers
   * become floats. An array that is not there is a warning, but for the name "None", which is none,
   * too.
   */
  vtkSetStringMacro(ColorArrayName);
  vtkGetStringMacro(ColorArrayName);
  //@}

protected:
  vtkImageToSVO();
  ~vtkImageToSVO() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkDataArray* FindScalars(vtkInformationVector** inputVector, vtkImageData* image);
  vtkDataArray* FindColors(vtkImageData* image);
  std::vector<double> Surfaces();
  void WarnOfNothing(vtkImageData* image, vtkDataArray* scalars, double voxel);
  svo::SourceOctree Convert(
    vtkImageData* image, vtkDataArray* asked, const int whole[6], vtkPolyData* output);

  double Value = 0.0;
  vtkNew<vtkContourValues> Contours;
  int MaximumLevel = 0;
  char* ColorArrayName = nullptr;

  // What is known of the last image for any value, see svoImageSource.h.
  std::shared_ptr<const svo::ValuePyramid> Pyramid;
  const void* PyramidScalars = nullptr; // only compared
  vtkMTimeType PyramidTime = 0;
};

#endif
