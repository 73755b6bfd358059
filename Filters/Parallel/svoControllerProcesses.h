// The processes of a vtkMultiProcessController.
#ifndef svoControllerProcesses_h
#define svoControllerProcesses_h

#include "svoProcesses.h"
#include "vtkSVOParallelModule.h"

class vtkMultiProcessController;

namespace svo
{
class VTKSVOPARALLEL_EXPORT ControllerProcesses : public Processes
{
public:
  /// The controller must live as long.
  explicit ControllerProcesses(vtkMultiProcessController* controller)
    : Controller(controller)
  {
  }
  int count() const override;
  int self() const override;
  void gather(const std::vector<unsigned char>& own, std::vector<unsigned char>& all,
    std::vector<std::size_t>& begins) override;
  void minimum(std::vector<std::uint64_t>& values) override;

private:
  vtkMultiProcessController* Controller;
};
}

#endif
