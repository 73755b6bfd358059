/**
 * @class vtkSMSVOFrameInformationDomain
 * @brief keeps a view's property for information up to date, so that a panel can show it
 *
 * ParaView asks for such properties when something wants to know them; a panel only asks when it
 * is made. A property of a view's proxy with this domain is asked for after each still frame.
 * The domain restricts nothing.
 */
#ifndef vtkSMSVOFrameInformationDomain_h
#define vtkSMSVOFrameInformationDomain_h

#include "vtkSMDomain.h"
#include "vtkSVOViewsModule.h" // for the export macro

class vtkObject;

class VTKSVOVIEWS_EXPORT vtkSMSVOFrameInformationDomain : public vtkSMDomain
{
public:
  static vtkSMSVOFrameInformationDomain* New();
  vtkTypeMacro(vtkSMSVOFrameInformationDomain, vtkSMDomain);

protected:
  vtkSMSVOFrameInformationDomain() = default;
  ~vtkSMSVOFrameInformationDomain() override = default;

  int ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element) override;

private:
  void FrameEnds(vtkObject* view, unsigned long event, void* interactive);
};

#endif
