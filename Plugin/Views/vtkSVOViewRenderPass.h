/**
 * @class vtkSVOViewRenderPass
 * @brief a render pass that speaks to users of ParaView
 *
 * Its messages open a window, and ask for what can be done in ParaView's panels.
 */
#ifndef vtkSVOViewRenderPass_h
#define vtkSVOViewRenderPass_h

#include "vtkSVORenderPass.h"
#include "vtkSVOViewsModule.h" // for the export macro
#include "vtkWeakPointer.h"    // for vtkWeakPointer

class vtkPVRenderView;

class VTKSVOVIEWS_EXPORT vtkSVOViewRenderPass : public vtkSVORenderPass
{
public:
  static vtkSVOViewRenderPass* New();
  vtkTypeMacro(vtkSVOViewRenderPass, vtkSVORenderPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  //@{
  /**
   * Along which axis a ground that shows nothing but shadows is put below the data of the view:
   * 0 (the default) there is none, 1, 2, 3: x, y, z.
   */
  vtkSetClampMacro(ShadowGround, int, 0, 3);
  vtkGetMacro(ShadowGround, int);
  //@}

  /**
   * The view whose lights are told by the names that its panels give them.
   */
  void SetView(vtkPVRenderView* view);

protected:
  vtkSVOViewRenderPass();
  ~vtkSVOViewRenderPass() override;

  std::string GetText(int text, vtkLight* about) const override;

private:
  std::string NameOf(vtkLight* light) const;

  int ShadowGround = 0;
  vtkWeakPointer<vtkPVRenderView> View;
};

#endif
