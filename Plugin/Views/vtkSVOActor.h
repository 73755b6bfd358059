/**
 * @class vtkSVOActor
 * @brief an actor of ParaView that leaves its surface to a render pass while that traces it
 *
 * It is there for everything else: bounds, selection, and the rasteriser's picture where the
 * surface cannot be traced.
 */
#ifndef vtkSVOActor_h
#define vtkSVOActor_h

#include "vtkPVLODActor.h"
#include "vtkSVOViewsModule.h" // for the export macro
#include "vtkWeakPointer.h"

class vtkSVORenderPass;

class VTKSVOVIEWS_EXPORT vtkSVOActor : public vtkPVLODActor
{
public:
  static vtkSVOActor* New();
  vtkTypeMacro(vtkSVOActor, vtkPVLODActor);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The pass that may trace the actor. Null (the default): it is rasterised.
   */
  void SetPass(vtkSVORenderPass* pass);

  int RenderOpaqueGeometry(vtkViewport* viewport) override;

protected:
  vtkSVOActor();
  ~vtkSVOActor() override;

private:
  vtkSVOActor(const vtkSVOActor&) = delete;
  void operator=(const vtkSVOActor&) = delete;

  vtkWeakPointer<vtkSVORenderPass> Pass;
};

#endif
