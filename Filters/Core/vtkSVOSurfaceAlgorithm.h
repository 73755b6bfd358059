/**
 * @class vtkSVOSurfaceAlgorithm
 * @brief what converts something without triangles into an octree, and a mesh that carries it
 *
 * The settings and figures that all of these have.
 *
 * @sa vtkImageToSVO vtkImplicitFunctionToSVO vtkSVOVDBReader
 */
#ifndef vtkSVOSurfaceAlgorithm_h
#define vtkSVOSurfaceAlgorithm_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkSVOCoreModule.h" // for the export macro

namespace svo
{
struct SourceOctree;
}

class VTKSVOCORE_EXPORT vtkSVOSurfaceAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(vtkSVOSurfaceAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  //@{
  /**
   * Memory that the build may use at its peak, in KiB; default 0: what the machine has available. A
   * build that needs more ends with an error.
   */
  vtkSetMacro(MemoryLimit, unsigned long);
  vtkGetMacro(MemoryLimit, unsigned long);
  //@}

  //@{
  /**
   * How large the output's mesh may get: its contour has about as many quads as the octree has
   * cells at the deepest level that has at most this many. 1 to 500 million, values outside are
   * clamped; default 1 million. A quad takes about 44 bytes.
   */
  vtkSetClampMacro(MaximumNumberOfQuads, vtkIdType, 1, 500000000);
  vtkGetMacro(MaximumNumberOfQuads, vtkIdType);
  //@}

  //@{
  /**
   * Whether the output's field data also says, in arrays of one value, what the octree is like:
   * "SVO Level", "SVO Voxels", "SVO Memory" (KiB) and "SVO Build Time" (s). For programs that show
   * field data to people. Default off.
   */
  vtkSetMacro(WriteStatistics, bool);
  vtkGetMacro(WriteStatistics, bool);
  vtkBooleanMacro(WriteStatistics, bool);
  //@}

  //@{
  /**
   * Occupied voxels of the last execution's octree, 0 if none, and how long it took to build, in
   * seconds.
   */
  vtkGetMacro(NumberOfVoxels, vtkIdType);
  vtkGetMacro(BuildTime, double);
  //@}

protected:
  vtkSVOSurfaceAlgorithm() = default;
  ~vtkSVOSurfaceAlgorithm() override = default;

#ifndef __VTK_WRAP__
  /// The output, empty, and no figures.
  vtkPolyData* Begin(vtkInformationVector* outputVector);
  /// The figures of what was built since `start`, vtkTimerLog's universal time.
  void NoteBuilt(const svo::SourceOctree& built, double start, vtkPolyData* output);
#endif

  unsigned long MemoryLimit = 0;
  vtkIdType MaximumNumberOfQuads = 1000000;
  bool WriteStatistics = false;
  vtkIdType NumberOfVoxels = 0;
  double BuildTime = 0.0;
};

#endif
