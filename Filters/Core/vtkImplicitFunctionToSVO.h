/**
 * @class vtkImplicitFunctionToSVO
 * @brief converts the surface of an implicit function into a sparse voxel octree, without triangles
 *
 * The surface is where the function takes a value, within a box of interest. The box is cut into
 * eight, again and again, only where the surface may be, so that the function is never sampled on a
 * dense grid: time and memory go with the surface. Each voxel of the last level that the surface
 * touches keeps a plane, from the function's value and gradient.
 *
 * The output is a contour of the voxels' planes, quads with normals, that carries the octree in its
 * field data. So bounds, outlines, pickers and files work as they do with any mesh;
 * vtkSVORenderPass traces the octree, and VTK's rasteriser, where it has to draw (clipping planes,
 * opacity, edges and more), draws the contour. See SetMaximumNumberOfQuads(). A filter downstream
 * that changes points or cells leaves an octree that is recognised as foreign.
 *
 * Where the function's gradient has a known bound, see SetGradientBound(), nothing is missed. Else
 * the function is sampled nine times in each cube, from the cubes of MinimumLevel on, and parts of
 * a surface that are smaller than those and do not show in the samples can be missed.
 *
 * The function is asked by several threads at a time, see SetParallel(). Values that are not finite
 * are no part of any surface. What cannot be converted leads to one message and an output without
 * cells: no function, a box that is empty or not finite, an octree that needs more memory than
 * there is (errors), no surface in the box (warning). The build reports progress and can be
 * aborted; the output then has no cells.
 *
 * @sa vtkPolyDataToSVO vtkSparseVoxelOctree vtkSVORenderPass vtkSampleFunction
 */
#ifndef vtkImplicitFunctionToSVO_h
#define vtkImplicitFunctionToSVO_h

#include "vtkSVOCoreModule.h" // for the export macro
#include "vtkSVOSurfaceAlgorithm.h"

class vtkImplicitFunction;

class VTKSVOCORE_EXPORT vtkImplicitFunctionToSVO : public vtkSVOSurfaceAlgorithm
{
public:
  static vtkImplicitFunctionToSVO* New();
  vtkTypeMacro(vtkImplicitFunctionToSVO, vtkSVOSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The time of the function counts, too.
   */
  vtkMTimeType GetMTime() override;

  //@{
  /**
   * The function. Where its gradient is more than 20 degrees, or a third, off what differences of
   * its values say, these count: vtkImplicitBoolean of VTK 9.1 has such ones.
   */
  virtual void SetImplicitFunction(vtkImplicitFunction* function);
  vtkGetObjectMacro(ImplicitFunction, vtkImplicitFunction);
  //@}

  //@{
  /**
   * The value that the function takes on the surface; default 0.
   */
  vtkSetMacro(Value, double);
  vtkGetMacro(Value, double);
  //@}

  //@{
  /**
   * The box that the surface is looked for in: xmin, xmax, ymin, ymax, zmin, zmax; default -1 to 1
   * on each axis. The octree's cube has its longest edge. A surface that leaves the box is cut off
   * there, within a voxel.
   */
  vtkSetVector6Macro(ModelBounds, double);
  vtkGetVector6Macro(ModelBounds, double);
  //@}

  //@{
  /**
   * Depth of the octree: 2^level voxels along an edge of its cube. 1 to 20, values outside are
   * clamped; default 8.
   */
  vtkSetClampMacro(MaximumLevel, int, 1, 20);
  vtkGetMacro(MaximumLevel, int);
  //@}

  //@{
  /**
   * A length that no gradient of the function exceeds in the box: 1 for a distance. It need not be
   * the least such length, but the closer, the less is examined. With one that is too short parts
   * of the surface are missed. 0 (default): not known.
   */
  vtkSetClampMacro(GradientBound, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(GradientBound, double);
  //@}

  //@{
  /**
   * Without a bound: the level down to which all cubes are cut before samples decide. One level
   * more finds parts of the surface of half the size, and takes eight times the samples. 0 to 10,
   * default 5.
   */
  vtkSetClampMacro(MinimumLevel, int, 0, 10);
  vtkGetMacro(MinimumLevel, int);
  //@}

  //@{
  /**
   * Whether several threads ask the function at a time. Default on, as in vtkSampleFunction. To be
   * turned off for functions that keep something from call to call, as vtkImplicitDataSet does.
   */
  vtkSetMacro(Parallel, bool);
  vtkGetMacro(Parallel, bool);
  vtkBooleanMacro(Parallel, bool);
  //@}

protected:
  vtkImplicitFunctionToSVO();
  ~vtkImplicitFunctionToSVO() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkImplicitFunction* ImplicitFunction = nullptr;
  double Value = 0.0;
  double ModelBounds[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
  int MaximumLevel = 8;
  double GradientBound = 0.0;
  int MinimumLevel = 5;
  bool Parallel = true;
};

#endif
