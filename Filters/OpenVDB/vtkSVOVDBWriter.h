/**
 * @class vtkSVOVDBWriter
 * @brief writes a sparse voxel octree as grids of an OpenVDB file
 *
 * The input is any polydata that carries an octree: of vtkPolyDataToSVO, or of a source without
 * triangles. The file has a grid "leaves" that masks the octree's leaves (bools, active and true
 * there), which lies where the octree does in the polydata's coordinates (not the actor's).
 * vtkSVOVDBReader reads the same leaves again, and any program that uses OpenVDB can.
 *
 * On request there is a level set "surface" as well: a narrow band of distances, negative inside,
 * measured from the mesh's triangles where there are any, else from the planes of the leaves, or
 * from the faces of voxels. What encloses nothing has no inside (a warning); voxels that are
 * stretched or sheared have no level set (a warning, and the leaves are written alone).
 *
 * On several processes the first one writes what all of them have: the leaves of a surface whose
 * parts they hold, with voxels in common (vtkPPolyDataToSVO, vtkImageToSVO). Then all have to call
 * Write(). A level set is written where one process has all of the surface; else a warning says
 * that it is left out.
 *
 * Both say in their metadata which program and which level they come from. An octree that is
 * missing or does not fit, and a file that cannot be written, lead to one error; the file stays as
 * it was then, and GetErrorCode() is not 0.
 *
 * @sa vtkSVOVDBReader vtkPolyDataToSVO
 */
#ifndef vtkSVOVDBWriter_h
#define vtkSVOVDBWriter_h

#include "vtkSVOOpenVDBModule.h" // for the export macro
#include "vtkWriter.h"

class vtkMultiProcessController;

class VTKSVOOPENVDB_EXPORT vtkSVOVDBWriter : public vtkWriter
{
public:
  static vtkSVOVDBWriter* New();
  vtkTypeMacro(vtkSVOVDBWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  //@{
  /**
   * The file to write. One that is there is replaced when the new one is complete.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  //@}

  //@{
  /**
   * Whether to write a level set, too; default off.
   */
  vtkSetMacro(WriteLevelSet, bool);
  vtkGetMacro(WriteLevelSet, bool);
  vtkBooleanMacro(WriteLevelSet, bool);
  //@}

  //@{
  /**
   * Half of the width of the level set's band, in voxels: 1 to 100, values outside are clamped;
   * default 3, as is usual with OpenVDB.
   */
  vtkSetClampMacro(HalfWidth, double, 1.0, 100.0);
  vtkGetMacro(HalfWidth, double);
  //@}

  //@{
  /**
   * The processes that write one file together; default the global controller, nullptr for a file
   * of this process alone.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  //@}

  int ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

protected:
  vtkSVOVDBWriter();
  ~vtkSVOVDBWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  class vtkInternals; // grids, and what they are made of
  bool IsParallel();
  void WriteAlone(vtkInternals& own);
  void WriteParts(vtkInternals& own);
  void MakeGrids(vtkInternals& own, bool levelSet);
  void WriteGrids(vtkInternals& own);

  vtkMultiProcessController* Controller = nullptr;
  char* FileName = nullptr;
  bool WriteLevelSet = false;
  double HalfWidth = 3.0;
};

#endif
