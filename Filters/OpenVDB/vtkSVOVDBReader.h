/**
 * @class vtkSVOVDBReader
 * @brief reads a grid of an OpenVDB file as a sparse voxel octree
 *
 * Each leaf of the octree is a voxel of the grid: nothing is resampled. As in OpenVDB, voxel (i, j,
 * k) is the cube of index space from i - 1/2 to i + 1/2. The grid's map, any affine one, takes it
 * to where it lies: stretched, turned, mirrored and sheared grids stay what they are.
 *
 * Level sets become surfaces: voxels that the surface passes, each with a plane. All other grids
 * become voxels: the active ones above a threshold, inner ones as well. SetConversion() chooses
 * otherwise. Grids of float (also stored as half), double, int32, int64, bool and mask can be
 * read. Constant tiles count as the voxels that they stand for. A surface is that of the trilinear
 * field of all values, active or not, tiles and the background included.
 *
 * The output is a contour of the surface that carries the octree in its field data, as that of
 * vtkImplicitFunctionToSVO is, or, of voxels, faces of coarse cubes; the string array "VDBMetadata"
 * beside it has the grid's and the file's metadata, a "name: value" each.
 *
 * Several files are time steps, 0, 1, 2 and so on, in the order in which they were added.
 *
 * Where constant tiles stand for voxels a MemoryLimit of 0 means 4 GiB of them.
 * MaximumNumberOfQuads is of surfaces: where leaves are voxels, the mesh has the faces of cells of
 * level 5.
 *
 * What cannot be read leads to one message and an output without cells: a file that is missing,
 * truncated or no OpenVDB file, a grid that it does not have (the message names those that it has),
 * a frustum map, grids of points and vectors, more voxels than there is memory for (errors); a grid
 * without anything that is occupied (warning). After an error GetErrorCode() is one of
 * vtkErrorCode, as of VTK's readers: UserError where the file has no grid of that name,
 * UnknownError where a grid has no octree.
 *
 * @sa vtkSVOVDBWriter vtkImageToSVO vtkSparseVoxelOctree
 */
#ifndef vtkSVOVDBReader_h
#define vtkSVOVDBReader_h

#include "vtkSVOOpenVDBModule.h" // for the export macro
#include "vtkSVOSurfaceAlgorithm.h"

#include <memory> // for std::unique_ptr
#include <string> // for what only this class sees

class vtkPolyData;
class vtkStringArray;

namespace svo
{
struct SourceOctree;
struct VDBOptions;
}

class VTKSVOOPENVDB_EXPORT vtkSVOVDBReader : public vtkSVOSurfaceAlgorithm
{
public:
  static vtkSVOVDBReader* New();
  vtkTypeMacro(vtkSVOVDBReader, vtkSVOSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  //@{
  /**
   * The file to read, in the place of all that were set or added. Get: the first one; nullptr if
   * there is none.
   */
  void SetFileName(const char* fileName);
  const char* GetFileName();
  //@}

  //@{
  /**
   * Files that are time steps, in this order.
   */
  void AddFileName(const char* fileName);
  void RemoveAllFileNames();
  int GetNumberOfFileNames();
  const char* GetFileName(int i);
  //@}

  /**
   * 1 if the file can be opened and is OpenVDB's by its first bytes, else 0.
   */
  int CanReadFile(const char* fileName);

  //@{
  /**
   * The grid to read. Empty (default): the first one, by name. Several grids of one name are
   * called "name[0]", "name[1]" and so on; the name alone is the first of them.
   */
  void SetGridName(const char* name);
  vtkGetCharFromStdStringMacro(GridName);
  //@}

  //@{
  /**
   * Another grid of the file, of numbers or of vectors of three, that colours the octree; default
   * none, and so is "None". Each voxel keeps that grid's trilinear value at the surface in it,
   * whatever the two grids' maps are: the output has field data of the grid's name with a tuple for
   * each voxel, and cell data of the same name, for mappers, as vtkImageToSVO::SetColorArrayName()
   * says. A grid that is not there, or has no numbers, is a warning.
   */
  void SetColorGridName(const char* name);
  vtkGetCharFromStdStringMacro(ColorGridName);
  //@}

  //@{
  /**
   * The grids of the (first) file, in the order of their names. The file is looked at when this is
   * asked, without a pipeline. 0 grids, and one error, if it cannot be read; nullptr for an index
   * out of range. GetGridNames() leaves the error to the execution.
   */
  int GetNumberOfGrids();
  const char* GetGridName(int i);
  vtkStringArray* GetGridNames();
  //@}

  /// What a grid is taken for.
  enum ConversionType
  {
    AUTOMATIC = 0,
    SURFACE = 1,
    VOXELS = 2
  };

  //@{
  /**
   * Automatic (default): level sets become surfaces, all other grids voxels. Surface: any grid of
   * numbers is a surface where it takes the threshold (level sets: 0). Voxels: all are voxels.
   */
  vtkSetClampMacro(Conversion, int, AUTOMATIC, VOXELS);
  vtkGetMacro(Conversion, int);
  void SetConversionToAutomatic() { this->SetConversion(AUTOMATIC); }
  void SetConversionToSurface() { this->SetConversion(SURFACE); }
  void SetConversionToVoxels() { this->SetConversion(VOXELS); }
  //@}

  //@{
  /**
   * Active voxels with values above this are occupied; default 0. Bools and masks have none: active
   * and true is occupied. It is also where other grids than level sets have their surface. Not a
   * number: an error, and the threshold stays.
   */
  void SetThreshold(double threshold);
  vtkGetMacro(Threshold, double);
  //@}

  //@{
  /**
   * Of the last execution: how long it took to read the grid, in seconds; the metadata of the grid
   * and of the file, a "name: value" a line. They are empty, or 0, before Update().
   */
  vtkGetMacro(ReadTime, double);
  vtkGetCharFromStdStringMacro(MetaData);
  //@}

protected:
  vtkSVOVDBReader();
  ~vtkSVOVDBReader() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  template <class T>
  void Set(T& own, const T& value);
  std::string ReadContents();
  const char* FileOfStep(vtkInformationVector* outputVector);
  bool ColorBy(const char* file, const svo::SourceOctree& built, const svo::VDBOptions& options,
    vtkPolyData* output);

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
  std::string GridName;
  std::string ColorGridName;
  std::string MetaData;
  int Conversion = AUTOMATIC;
  double Threshold = 0.0;
  double ReadTime = 0.0;
};

#endif
