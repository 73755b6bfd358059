/**
 * @class vtkSVORepresentation
 * @brief ParaView's surface representation, traced through octrees, with shadows
 *
 * Surfaces that come without an octree get one before they are handed to the view, so that the
 * octree travels with the surface to wherever it is drawn and stays with it in ParaView's cache of
 * time steps. What cannot be traced (see vtkSVORenderPass) is rasterised, as in the surface
 * representation.
 */
#ifndef vtkSVORepresentation_h
#define vtkSVORepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkNew.h"            // for vtkNew
#include "vtkSVOViewsModule.h" // for the export macro
#include "vtkWeakPointer.h"    // for vtkWeakPointer

class vtkDataObject;
class vtkPPolyDataToSVO;

class VTKSVOVIEWS_EXPORT vtkSVORepresentation : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkSVORepresentation* New();
  vtkTypeMacro(vtkSVORepresentation, vtkGeometryRepresentationWithFaces);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  //@{
  /**
   * Octrees that are built here; see vtkPolyDataToSVO. A surface that comes with an octree keeps
   * it.
   */
  void SetMaximumLevel(int level);
  int GetMaximumLevel();
  void SetLeafGeometry(int geometry);
  int GetLeafGeometry();
  void SetCacheMemoryLimit(vtkIdType kibibytes);
  vtkIdType GetCacheMemoryLimit();
  //@}

  //@{
  /**
   * Whether the surface casts shadows, and whether shadows fall on it. Default on. Of translucent
   * surfaces see vtkSVORenderPass::SetTranslucentShadows(), which is the view's.
   */
  void SetCastShadows(bool cast);
  bool GetCastShadows();
  void SetReceiveShadows(bool receive);
  bool GetReceiveShadows();
  //@}

  //@{
  /**
   * Largest projected edge of the voxels where rays stop, in pixels, 0..64; negative (the default):
   * the view's.
   */
  void SetPixelError(double error);
  double GetPixelError();
  //@}

  //@{
  /**
   * How many octrees were built so far, and memory of those that are kept, in KiB.
   */
  vtkIdType GetNumberOfBuilds();
  vtkIdType GetCacheMemorySize();
  //@}

  //@{
  /**
   * In an interactive frame an update does not wait for octrees: surfaces go out with those that
   * there are (see vtkPolyDataToSVO::SetBuildOctrees), or without, and the render pass builds what
   * it needs in the background. The same on all processes.
   */
  void SetInteractive(bool interactive);
  bool GetInteractive();
  //@}

  //@{
  /**
   * Whether the last update was one of an interactive frame, and makes another one necessary, which
   * is complete.
   */
  vtkGetMacro(UpdatedInteractively, bool);
  void CompleteUpdate();
  //@}

  void SetVisibility(bool visible) override;

  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo) override;

  /**
   * Octrees have their own levels of detail; the decimated surface that other representations show
   * during interaction is never made.
   */
  void SetSuppressLOD(bool) override {}

protected:
  vtkSVORepresentation();
  ~vtkSVORepresentation() override;

  void SetupDefaults() override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

private:
  void UpdateUse(vtkView* view);
  void ForgetPieces();
  void ForwardProgress();

  vtkNew<vtkPPolyDataToSVO> ToOctree;
  bool UpdatedInteractively = false;
  unsigned long Size = 0;                      // KiB, of the last complete surface with its octrees
  vtkWeakPointer<vtkDataObject> ShownAsDetail; // in the last picture
  vtkWeakPointer<vtkView> Used;                // the view whose pass this one is a user of
};

#endif
