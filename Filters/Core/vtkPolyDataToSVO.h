/**
 * @class vtkPolyDataToSVO
 * @brief converts polygons into a sparse voxel octree that travels with them
 *
 * The output is the input mesh, unchanged, with an octree of its surface in a field-data array. So
 * the output can be drawn, picked, written to a .vtp file and read again like any mesh (not to an
 * ASCII .vtk file, which rounds the points, so that the octree is not theirs any more), and
 * vtkSVORenderPass traces the octree instead of building its own. vtkSparseVoxelOctree opens the
 * octree for questions, vtkSVOToPolyData shows its cells.
 *
 * Polygons of any size and triangle strips are converted; vertices and lines pass through and have
 * no part in the octree. The octree remembers a signature of the mesh, so that a filter downstream
 * that changes points or cells leaves an octree that is recognised as foreign. An input that
 * already carries a fitting octree of the same level and leaf geometry keeps it, without a build.
 * So does the contour of a surface that is no mesh (vtkImplicitFunctionToSVO), whatever the level.
 *
 * Animated meshes: the octree of each time step (or of each block of a composite dataset, or of any
 * mesh that comes along) is built once and kept, see SetCacheTimeSteps().
 *
 * What the filter cannot use leads to one message, and the mesh always passes through:
 * triangles with a point that is not finite are left out (a warning with their number, for the
 * first of all time steps and blocks that have some), a mesh without polygons gets an octree
 * without voxels (no message), all points in one place are one voxel (warning), and an octree that
 * needs more memory than there is, is refused before it is built (error that names the size; the
 * output has no octree).
 *
 * The build reports progress. If it is aborted (SetAbortExecute(1) in a ProgressEvent observer),
 * the output is the mesh without an octree; Modified() makes the next Update() try again. With VTK
 * 9.3, and with the VTK of ParaView 5.11, the output is empty instead, as VTK does it there, and
 * SetAbortExecute(0) makes the next Update() try again.
 *
 * @sa vtkSparseVoxelOctree vtkSVOToPolyData vtkSVORenderPass
 */
#ifndef vtkPolyDataToSVO_h
#define vtkPolyDataToSVO_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkSVOCoreModule.h" // for the export macro

#include <memory> // for std::unique_ptr

class VTKSVOCORE_EXPORT vtkPolyDataToSVO : public vtkPolyDataAlgorithm
{
public:
  static vtkPolyDataToSVO* New();
  vtkTypeMacro(vtkPolyDataToSVO, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  //@{
  /**
   * Depth of the octree: 2^level voxels along an edge of the mesh's bounding cube. 1 to 20, values
   * outside are clamped; default 10. One level more is half the voxel size, and four times the
   * voxels.
   */
  vtkSetClampMacro(MaximumLevel, int, 1, 20);
  vtkGetMacro(MaximumLevel, int);
  //@}

  //@{
  /**
   * Whether MaximumLevel is a limit: where triangles are exact (leaf geometry Triangle or
   * Automatic), octrees get no more levels than it takes to tell the mesh's triangles apart. They
   * look the same, and those of meshes of few triangles, as blocks are, take a small part of the
   * memory and of the time to build. IsOccupied() of vtkSparseVoxelOctree is as coarse then.
   * Default off. See GetNumberOfLevels() of vtkSparseVoxelOctree for what it came to.
   */
  vtkSetMacro(AdaptLevel, bool);
  vtkGetMacro(AdaptLevel, bool);
  vtkBooleanMacro(AdaptLevel, bool);
  //@}

  /**
   * What a ray meets in an occupied voxel.
   */
  enum LeafGeometryType
  {
    VOXEL = 0,
    PLANE = 1,
    TRIANGLE = 2,
    AUTOMATIC = 3
  };

  //@{
  /**
   * What a ray meets in an occupied voxel:
   * - Voxel: the cube, where the ray enters it; the least work for a single ray;
   * - Plane: the plane of one of the triangles in the voxel;
   * - Triangle: the triangles themselves, exactly; fastest in pictures where they look larger than
   *   about a pixel;
   * - Automatic (default): triangles where they are few, planes where they are many. A render pass
   *   goes by what a view shows: it takes planes only for triangles smaller than about a pixel.
   */
  vtkSetClampMacro(LeafGeometry, int, VOXEL, AUTOMATIC);
  vtkGetMacro(LeafGeometry, int);
  void SetLeafGeometryToVoxel() { this->SetLeafGeometry(VOXEL); }
  void SetLeafGeometryToPlane() { this->SetLeafGeometry(PLANE); }
  void SetLeafGeometryToTriangle() { this->SetLeafGeometry(TRIANGLE); }
  void SetLeafGeometryToAutomatic() { this->SetLeafGeometry(AUTOMATIC); }
  const char* GetLeafGeometryAsString();
  //@}

  //@{
  /**
   * Bounds of what the mesh is a part of, in its local coordinates. The octree's cube is then that
   * of the whole, so that parts that are converted apart have the voxels that the whole would have.
   * A mesh that reaches beyond makes the cube larger. Default: low above high on each axis, which
   * means that the mesh is all there is. Bounds that are not finite are refused, with a warning.
   */
  virtual void SetModelBounds(
    double xMin, double xMax, double yMin, double yMax, double zMin, double zMax);
  virtual void SetModelBounds(const double bounds[6]);
  vtkGetVector6Macro(ModelBounds, double);
  //@}

  //@{
  /**
   * Whether octrees are kept after use, so that a time step that comes again is not built again.
   * Default on. They are recognised by the mesh's signature, the level and the leaf geometry, not
   * by the time: identical poses share one octree. Turning it off releases them.
   */
  virtual void SetCacheTimeSteps(bool cache);
  vtkGetMacro(CacheTimeSteps, bool);
  vtkBooleanMacro(CacheTimeSteps, bool);
  //@}

  //@{
  /**
   * Memory that the kept octrees may use, in KiB; default 1048576 (1 GiB). The one that is
   * expected to be used last goes first: the least recently used one, but of a loop that is longer
   * than the memory the pose that has just passed. An octree larger than this is not kept.
   */
  virtual void SetCacheMemoryLimit(unsigned long kibibytes);
  vtkGetMacro(CacheMemoryLimit, unsigned long);
  //@}

  //@{
  /**
   * Whether a mesh that comes with an octree keeps it, whatever its level and leaf geometry.
   * Default off: it is kept only if it is what would be built.
   */
  vtkSetMacro(KeepOctrees, bool);
  vtkGetMacro(KeepOctrees, bool);
  vtkBooleanMacro(KeepOctrees, bool);
  //@}

  //@{
  /**
   * Whether octrees that are not kept are built. Off: a mesh goes out with the octree of it that
   * was used last, of whatever level and leaf geometry, else with the one that it brings, else
   * without; for programs that must answer at once. Turned on again, the next Update() builds what
   * is missing. Default on.
   */
  virtual void SetBuildOctrees(bool build);
  vtkGetMacro(BuildOctrees, bool);
  vtkBooleanMacro(BuildOctrees, bool);
  //@}

  //@{
  /**
   * Whether the output's field data also says, in arrays of one value, what the octree is like:
   * "SVO Level", "SVO Voxels", "SVO Memory" (KiB) and "SVO Build Time" (s, 0 if it was not built
   * now). For programs that show field data to people. Default off.
   */
  vtkSetMacro(WriteStatistics, bool);
  vtkGetMacro(WriteStatistics, bool);
  vtkBooleanMacro(WriteStatistics, bool);
  //@}

  //@{
  /**
   * Memory that one build may use at its peak, in KiB; default 0: what the machine has available. A
   * build that is expected to need more is refused with an error.
   */
  vtkSetMacro(MemoryLimit, unsigned long);
  vtkGetMacro(MemoryLimit, unsigned long);
  //@}

  /**
   * Lets go of the kept octrees. Outputs keep theirs.
   */
  void ReleaseCache();

  /**
   * Memory of the kept octrees in KiB, rounded up.
   */
  unsigned long GetCacheMemorySize();

  /**
   * How many octrees are kept.
   */
  int GetNumberOfCachedOctrees();

  //@{
  /**
   * How many octrees this filter has built so far, and how long the last execution took to build
   * one, in seconds (0 if it built none).
   */
  vtkGetMacro(NumberOfBuilds, vtkIdType);
  vtkGetMacro(BuildTime, double);
  //@}

  /**
   * Occupied voxels of the octree that the last execution put on the output, 0 if none.
   */
  vtkGetMacro(NumberOfVoxels, vtkIdType);

protected:
  vtkPolyDataToSVO();
  ~vtkPolyDataToSVO() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /**
   * Makes the output of one execution: Convert() for each mesh.
   */
  virtual void ConvertInput(vtkDataObject* input, vtkDataObject* output);

  /**
   * Makes the output of one mesh, with an octree of the level.
   */
  void Convert(vtkPolyData* input, vtkPolyData* output, const double modelBounds[6], int level);

  /**
   * The largest voxel, in the mesh's units, that tells the mesh's triangles apart; 0 where
   * MaximumLevel is no limit but the level, or for a mesh that needs all of it.
   */
  double AdaptedVoxel(vtkPolyData* mesh);

private:
  int MaximumLevel = 10;
  int LeafGeometry = AUTOMATIC;
  bool AdaptLevel = false;
  double ModelBounds[6] = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  bool CacheTimeSteps = true;
  bool KeepOctrees = false;
  bool BuildOctrees = true;
  bool BuiltOctrees = true; // as it was in the last execution
  bool WriteStatistics = false;
  unsigned long CacheMemoryLimit = 1048576;
  unsigned long MemoryLimit = 0;
  vtkIdType NumberOfBuilds = 0;
  vtkIdType NumberOfVoxels = 0;
  double BuildTime = 0.0;

  void Finish(vtkPolyData* output);

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
