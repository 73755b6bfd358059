/**
 * @class vtkSVOViewPass
 * @brief the render pass of a render view
 *
 * Every view has one vtkSVORenderPass, which lives as long as the view's renderer. It holds the
 * settings that belong to the view, and is attached to the renderer while there is a representation
 * to trace, while everything is to cast shadows, or while there is a ground for shadows.
 */
#ifndef vtkSVOViewPass_h
#define vtkSVOViewPass_h

#include "vtkObject.h"
#include "vtkSVOViewsModule.h" // for the export macro
#include "vtkWeakPointer.h"    // for vtkWeakPointer

#include <memory> // for std::unique_ptr
#include <string> // for the reason

class vtkInformationObjectBaseKey;
class vtkPVDataRepresentation;
class vtkPVRenderView;
class vtkRenderer;
class vtkSVORenderPass;
class vtkSVOViewRenderPass;
class vtkView;
#ifndef __VTK_WRAP__
namespace svo
{
class ShadowGround;
}
#endif

class VTKSVOVIEWS_EXPORT vtkSVOViewPass : public vtkObject
{
public:
  static vtkSVOViewPass* New();
  vtkTypeMacro(vtkSVOViewPass, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The pass of a view, made when it is first asked for. Null if the view is no render view.
   */
  static vtkSVORenderPass* Of(vtkObjectBase* view);

  /**
   * Why what a representation shows in its view is left to the rasteriser, or casts no shadow or
   * less than its whole one, for people: as vtkSVORenderPass::GetReasonInLastFrame(), in the words
   * of ParaView's panels. Empty if all is as it was asked for, if it is not visible, or in another
   * kind of view.
   */
  static std::string GetReason(vtkPVDataRepresentation* shown);

  //@{
  /**
   * A representation that is traced comes or goes.
   */
  static void AddUser(vtkView* view);
  static void RemoveUser(vtkView* view);
  //@}

protected:
  vtkSVOViewPass();
  ~vtkSVOViewPass() override;

private:
  static vtkInformationObjectBaseKey* VIEW_PASS();
  static vtkSVOViewPass* OfView(vtkObjectBase* view);
  void UpdateAttachment();
  void BeginFrame();
  void EndFrame();

  vtkSVOViewRenderPass* Pass;
#ifndef __VTK_WRAP__
  std::unique_ptr<svo::ShadowGround> Ground;
#endif
  vtkWeakPointer<vtkPVRenderView> View;
  unsigned long Observers[2] = { 0, 0 }; // of the renderer, while the pass is attached to it
  int Users = 0;
};

#endif
