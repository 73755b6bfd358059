/**
 * @class vtkSMSVOViewInformationProperty
 * @brief a number that a view's vtkSVORenderPass knows, for information
 *
 * A property of a view is read on the client, whose pass has nothing to tell of frames that a
 * server rendered: then this one asks there. On the server, and without one, it is a
 * vtkSISVOViewProperty.
 */
#ifndef vtkSMSVOViewInformationProperty_h
#define vtkSMSVOViewInformationProperty_h

#include "vtkSMDoubleVectorProperty.h"
#include "vtkSVOViewsModule.h" // for the export macro

class VTKSVOVIEWS_EXPORT vtkSMSVOViewInformationProperty : public vtkSMDoubleVectorProperty
{
public:
  static vtkSMSVOViewInformationProperty* New();
  vtkTypeMacro(vtkSMSVOViewInformationProperty, vtkSMDoubleVectorProperty);

protected:
  vtkSMSVOViewInformationProperty() = default;
  ~vtkSMSVOViewInformationProperty() override = default;

  void ReadFrom(const vtkSMMessage* message, int offset, vtkSMProxyLocator* locator) override;
};

#endif
