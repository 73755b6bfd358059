/**
 * @class vtkSISVOLightProperty
 * @brief a property of a view's light that vtkSVORenderPass has: its size
 *
 * As of vtkSISVOViewProperty ParaView's class of lights can be given no methods, so a property with
 * the attribute si_class="vtkSISVOLightProperty" sets the size. Where ParaView was built with
 * OSPRay its own property, Radius, says as much; this one has the last word unless it is 0.
 */
#ifndef vtkSISVOLightProperty_h
#define vtkSISVOLightProperty_h

#include "vtkSIProperty.h"
#include "vtkSVOViewsModule.h" // for the export macro

class VTKSVOVIEWS_EXPORT vtkSISVOLightProperty : public vtkSIProperty
{
public:
  static vtkSISVOLightProperty* New();
  vtkTypeMacro(vtkSISVOLightProperty, vtkSIProperty);

protected:
  vtkSISVOLightProperty() = default;
  ~vtkSISVOLightProperty() override = default;

  bool Push(vtkSMMessage* message, int offset) override;
};

#endif
