/**
 * @class vtkPVSVOViewInformation
 * @brief what a view's vtkSVORenderPass answers, gathered from the process that renders
 */
#ifndef vtkPVSVOViewInformation_h
#define vtkPVSVOViewInformation_h

#include "vtkPVInformation.h"
#include "vtkSVOViewsModule.h" // for the export macro

#include <string> // for the command

class VTKSVOVIEWS_EXPORT vtkPVSVOViewInformation : public vtkPVInformation
{
public:
  static vtkPVSVOViewInformation* New();
  vtkTypeMacro(vtkPVSVOViewInformation, vtkPVInformation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The method of vtkSVORenderPass that is called; it gives a number.
   */
  void SetCommand(const char* command) { this->Command = command; }

  /**
   * The answer; 0 before there is one.
   */
  vtkGetMacro(Value, double);

  void CopyFromObject(vtkObject* view) override;
  void AddInformation(vtkPVInformation*) override {}
  void CopyToStream(vtkClientServerStream* stream) override;
  void CopyFromStream(const vtkClientServerStream* stream) override;
  void CopyParametersToStream(vtkMultiProcessStream& stream) override;
  void CopyParametersFromStream(vtkMultiProcessStream& stream) override;

protected:
  vtkPVSVOViewInformation() { this->SetRootOnly(1); }
  ~vtkPVSVOViewInformation() override = default;

private:
  std::string Command;
  double Value = 0.0;
};

#endif
