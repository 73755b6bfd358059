/**
 * @class vtkPPolyDataToSVO
 * @brief vtkPolyDataToSVO for surfaces that are spread over processes or over pieces
 *
 * The pieces of a surface get octrees of one cube, that of the whole surface: a level means the
 * same voxels, and the same level of detail, however many pieces there are and wherever they lie.
 * Pieces are what several processes have in the same place: as the input itself, as the same block
 * of a composite dataset, or in the same vtkPartitionedDataSet (vtkMultiPieceDataSet).
 *
 * Input and output are vtkPolyData or a vtkDataObjectTree of them; other leaves pass through.
 *
 * With more than one process each execution is a collective call: all processes of the controller
 * have to update the filter together, those without data with an empty vtkPolyData.
 * Settings have to be
 * the same for all of them.
 *
 * @sa vtkPolyDataToSVO
 */
#ifndef vtkPPolyDataToSVO_h
#define vtkPPolyDataToSVO_h

#include "vtkPolyDataToSVO.h"
#include "vtkSVOParallelModule.h" // for the export macro
#include "vtkSmartPointer.h"      // for Controller

class vtkMultiProcessController;

class VTKSVOPARALLEL_EXPORT vtkPPolyDataToSVO : public vtkPolyDataToSVO
{
public:
  static vtkPPolyDataToSVO* New();
  vtkTypeMacro(vtkPPolyDataToSVO, vtkPolyDataToSVO);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  //@{
  /**
   * The processes that hold parts of the input. Default: the global controller; null: there are no
   * others.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const;
  //@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

protected:
  vtkPPolyDataToSVO();
  ~vtkPPolyDataToSVO() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  void ConvertInput(vtkDataObject* input, vtkDataObject* output) override;

private:
  vtkSmartPointer<vtkMultiProcessController> Controller;
};

#endif
