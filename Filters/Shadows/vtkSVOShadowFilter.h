/**
 * @class vtkSVOShadowFilter
 * @brief adds to a mesh, as data, what lies in the shadow of which light
 *
 * Input 0 is the mesh to annotate. It casts shadows on itself, see SetMeshCasts(). Input 1 takes
 * any number of further casters: meshes, composite datasets of meshes, octrees of surfaces that are
 * no meshes (vtkImageToSVO, vtkImplicitFunctionToSVO). Casters that bring no octree of their own
 * get one inside of this filter, which is kept for when they come again, as time steps do.
 *
 * The output is the input mesh with up to two arrays more, for its cells or for its points:
 * - "Shadow": for each light, in the order of the lights, the share that gets nothing of it; 0 to 1
 *   of a cell's area, 0 or 1 for a point;
 * - "Exposure": what arrives of all lights, the sum of weight times (1 - Shadow), and with
 *   CosineWeighted times the cosine of the incidence. Colours, intensities and attenuations of
 *   lights have no part in it: weights say what a light brings.
 *
 * Rays are exact: in each caster's own coordinates, in double precision, against the triangles
 * themselves, which the octree keeps as floats in its cube. Answers can differ from those of exact
 * arithmetic only where a ray passes an edge of a triangle, or ends at a surface, within 2e-6 of
 * the longest side of that caster's bounds. Octrees of planes are met at their planes. The ray of a
 * point starts off its surface by what those floats resolve, and never meets the triangle that it
 * starts on. The result does not depend on the number of threads.
 *
 * Nothing arrives, so that a place counts as in shadow, of a light that is switched off, of a spot
 * light outside of its cone, and where the surface faces away from the light, see SetTwoSided().
 *
 * Lights are where they stand in the world. Camera lights and headlights have no place without a
 * camera: one warning, and nothing arrives of them. Cells without an area (vertices, lines), and
 * cells or points that are not finite, have NaN in both arrays; a warning tells the number of the
 * latter. One warning tells where nothing faces any of the lights.
 *
 * Time goes with samples times lights. Memory is that of the octrees and the arrays: see
 * SetWriteShadow(). Progress is reported, and the filter can be aborted; the output is the mesh
 * without arrays then.
 *
 * @sa vtkSVOSunPath vtkSVOSky vtkSVOExposureFilter vtkPolyDataToSVO
 */
#ifndef vtkSVOShadowFilter_h
#define vtkSVOShadowFilter_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkSVOShadowsModule.h" // for the export macro

#include <memory> // for std::unique_ptr

class vtkLight;
class vtkMatrix4x4;

class VTKSVOSHADOWS_EXPORT vtkSVOShadowFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkSVOShadowFilter* New();
  vtkTypeMacro(vtkSVOShadowFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The times of lights and matrices count, too.
   */
  vtkMTimeType GetMTime() override;

  //@{
  /**
   * Lights: directional (from the position to the focal point, from infinitely far away),
   * positional, or positional with a cone angle below 90 degrees. AddLight() gives the light a
   * weight of 1 and returns its index, -1 for no light. Removing a light, or a light that is not
   * there, moves those behind it up.
   */
  int AddLight(vtkLight* light);
  void RemoveLight(vtkLight* light);
  void RemoveAllLights();
  int GetNumberOfLights();
  vtkLight* GetLight(int index);
  //@}

  //@{
  /**
   * What a light brings in "Exposure": any unit, hours for example. Default 1. An index that does
   * not exist is an error; its weight is 0. SetWeights() gives another one for CosineWeighted; Get:
   * the one that counts now.
   */
  void SetWeight(int index, double weight);
  void SetWeights(int index, double weight, double withCosine);
  double GetWeight(int index);
  //@}

  //@{
  /**
   * The name of the light's component of "Shadow". Default: none. An index that does not exist is
   * an error; nullptr then.
   */
  void SetLightName(int index, const char* name);
  const char* GetLightName(int index);
  //@}

  /**
   * What gets the arrays.
   */
  enum AssociationType
  {
    POINT = 0,
    CELL = 1
  };

  //@{
  /**
   * Whether points or cells (default) get the arrays. The side that a point looks to is that of the
   * point normals, where the mesh has some, else the mean of its cells'.
   */
  vtkSetClampMacro(Association, int, POINT, CELL);
  vtkGetMacro(Association, int);
  void SetAssociationToPoint() { this->SetAssociation(POINT); }
  void SetAssociationToCell() { this->SetAssociation(CELL); }
  const char* GetAssociationAsString();
  //@}

  //@{
  /**
   * Points of a cell that are asked for, spread over its area, whatever its corners; of one alone,
   * the middle. 1 to 65536, default 16. Time grows with them.
   */
  vtkSetClampMacro(SamplesPerCell, int, 1, 65536);
  vtkGetMacro(SamplesPerCell, int);
  //@}

  //@{
  /**
   * Whether a surface that faces away from a light is asked for on the side that the light is on.
   * Off (default): it is in shadow, that of the body which it is the outside of; which side is the
   * outside is told by the order of a cell's points, or by point normals. To be turned on for
   * sheets with two sides, and for meshes whose cells are not oriented (vtkPolyDataNormals orients
   * them).
   */
  vtkSetMacro(TwoSided, bool);
  vtkGetMacro(TwoSided, bool);
  vtkBooleanMacro(TwoSided, bool);
  //@}

  //@{
  /**
   * Whether what arrives counts by the cosine of its incidence, as the heat of the sun on a surface
   * does. Off (default): it counts the same from all directions, as hours of sun do.
   */
  vtkSetMacro(CosineWeighted, bool);
  vtkGetMacro(CosineWeighted, bool);
  vtkBooleanMacro(CosineWeighted, bool);
  //@}

  //@{
  /**
   * Whether the mesh casts shadows on itself. Default on.
   */
  vtkSetMacro(MeshCasts, bool);
  vtkGetMacro(MeshCasts, bool);
  vtkBooleanMacro(MeshCasts, bool);
  //@}

  //@{
  /**
   * Whether there is an array "Shadow", which has four bytes a light for each cell or point.
   * Default on. "Exposure" is always there.
   */
  vtkSetMacro(WriteShadow, bool);
  vtkGetMacro(WriteShadow, bool);
  vtkBooleanMacro(WriteShadow, bool);
  //@}

  //@{
  /**
   * The matrix that takes the mesh to the world, where lights and casters are; affine, of any kind.
   * Default: none, the mesh is there. One without an inverse is an error.
   */
  virtual void SetMeshMatrix(vtkMatrix4x4* matrix);
  vtkGetObjectMacro(MeshMatrix, vtkMatrix4x4);
  //@}

  //@{
  /**
   * The same for the caster of a connection to input 1, by its index; all meshes of a composite
   * dataset have the one of their connection. A matrix without an inverse is a warning, and its
   * caster casts nothing. nullptr: none.
   */
  void SetCasterMatrix(int index, vtkMatrix4x4* matrix);
  vtkMatrix4x4* GetCasterMatrix(int index);
  //@}

  //@{
  /**
   * The same as AddInputConnection(1, port), AddInputDataObject(1, data), and
   * RemoveAllInputConnections(1) with all matrices of casters.
   */
  void AddCasterConnection(vtkAlgorithmOutput* port);
  void AddCasterData(vtkDataObject* data);
  void RemoveAllCasters();
  //@}

  //@{
  /**
   * Depth of octrees that are built here, at most: 2^level voxels along an edge of a caster's cube.
   * 1 to 20, default 10. It changes no answer; meshes of few triangles get less.
   */
  vtkSetClampMacro(MaximumLevel, int, 1, 20);
  vtkGetMacro(MaximumLevel, int);
  //@}

  //@{
  /**
   * Whether samples go to lights one by one. Slower; for tests of the fast path, whose answers
   * differ within the tolerance only. Default off.
   */
  vtkSetMacro(SingleRays, bool);
  vtkGetMacro(SingleRays, bool);
  vtkBooleanMacro(SingleRays, bool);
  //@}

  //@{
  /**
   * Of the last execution: seconds that it took to have the casters' octrees, and to trace.
   */
  vtkGetMacro(BuildTime, double);
  vtkGetMacro(TraceTime, double);
  //@}

protected:
  vtkSVOShadowFilter();
  ~vtkSVOShadowFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  /**
   * The time steps of the mesh and of all casters.
   */
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /**
   * Called at the beginning of each execution: subclasses may set the lights here. Says so if there
   * are none; an output without any light is right all the same.
   */
  virtual void PrepareLights();

private:
  int Association = CELL;
  int SamplesPerCell = 16;
  bool TwoSided = false;
  bool CosineWeighted = false;
  bool MeshCasts = true;
  bool WriteShadow = true;
  int MaximumLevel = 10;
  bool SingleRays = false;
  vtkMatrix4x4* MeshMatrix = nullptr;
  double BuildTime = 0.0;
  double TraceTime = 0.0;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
