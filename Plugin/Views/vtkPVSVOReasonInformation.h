/**
 * @class vtkPVSVOReasonInformation
 * @brief why surfaces of a view are not traced, or cast no shadow
 *
 * Gathered of a render view, or of one representation, from all processes: which of them draw a
 * surface depends on its size.
 */
#ifndef vtkPVSVOReasonInformation_h
#define vtkPVSVOReasonInformation_h

#include "vtkPVInformation.h"
#include "vtkSVOViewsModule.h" // for the export macro

#include <map>    // for the reasons
#include <string> // for the reasons

class VTKSVOVIEWS_EXPORT vtkPVSVOReasonInformation : public vtkPVInformation
{
public:
  static vtkPVSVOReasonInformation* New();
  vtkTypeMacro(vtkPVSVOReasonInformation, vtkPVInformation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Of a view a line for each source that is shown and has a reason, with its name; of a
   * representation its reason. See vtkSVOViewPass::GetReason(). `sources`: names of sources by
   * those that ParaView logs their representations with: "Sphere1(GeometryRepresentation)" in
   * ParaView 5.11, which needs no other name, "GeometryRepresentation1" in 5.13.
   */
  std::string GetText(const std::map<std::string, std::string>& sources = {}) const;

  void CopyFromObject(vtkObject* viewOrRepresentation) override;
  void AddInformation(vtkPVInformation* other) override;
  void CopyToStream(vtkClientServerStream* stream) override;
  void CopyFromStream(const vtkClientServerStream* stream) override;

protected:
  vtkPVSVOReasonInformation() = default;
  ~vtkPVSVOReasonInformation() override = default;

private:
  // By the name that its representation is logged with; without one: of a representation.
  std::map<std::string, std::string> Reasons;
};

#endif
