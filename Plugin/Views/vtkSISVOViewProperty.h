/**
 * @class vtkSISVOViewProperty
 * @brief a property of the render view that is meant for the view's vtkSVORenderPass
 *
 * ParaView lets a plugin add properties to the render view's proxy, but not methods to its class. A
 * property with the attribute si_class="vtkSISVOViewProperty" calls its command on the view's pass.
 */
#ifndef vtkSISVOViewProperty_h
#define vtkSISVOViewProperty_h

#include "vtkSIProperty.h"
#include "vtkSVOViewsModule.h" // for the export macro

class VTKSVOVIEWS_EXPORT vtkSISVOViewProperty : public vtkSIProperty
{
public:
  static vtkSISVOViewProperty* New();
  vtkTypeMacro(vtkSISVOViewProperty, vtkSIProperty);

protected:
  vtkSISVOViewProperty() = default;
  ~vtkSISVOViewProperty() override = default;

  /**
   * Defaults are not pushed: they are the pass's own.
   */
  bool Push(vtkSMMessage* message, int offset) override;

  /**
   * Properties for information are numbers (DoubleVectorProperty) or texts (StringVectorProperty).
   */
  bool Pull(vtkSMMessage* message) override;
};

#endif
