/**
 * @class vtkSMSVOReasonProperty
 * @brief why surfaces are not traced, or cast no shadow: a text of a view or of a representation
 *
 * It is asked for on all processes, see vtkPVSVOReasonInformation; what its command answers is not
 * used.
 */
#ifndef vtkSMSVOReasonProperty_h
#define vtkSMSVOReasonProperty_h

#include "vtkSMStringVectorProperty.h"
#include "vtkSVOViewsModule.h" // for the export macro

class VTKSVOVIEWS_EXPORT vtkSMSVOReasonProperty : public vtkSMStringVectorProperty
{
public:
  static vtkSMSVOReasonProperty* New();
  vtkTypeMacro(vtkSMSVOReasonProperty, vtkSMStringVectorProperty);

protected:
  vtkSMSVOReasonProperty() = default;
  ~vtkSMSVOReasonProperty() override = default;

  void ReadFrom(const vtkSMMessage* message, int offset, vtkSMProxyLocator* locator) override;
};

#endif
