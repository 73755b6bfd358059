#include "svoControllerProcesses.h"

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"
#include "vtkType.h"

namespace svo
{
int ControllerProcesses::count() const
{
  return this->Controller->GetNumberOfProcesses();
}

int ControllerProcesses::self() const
{
  return this->Controller->GetLocalProcessId();
}

void ControllerProcesses::gather(const std::vector<unsigned char>& own,
  std::vector<unsigned char>& all, std::vector<std::size_t>& begins)
{
  const int processes = this->count();
  const vtkIdType length = static_cast<vtkIdType>(own.size());
  std::vector<vtkIdType> lengths(processes), offsets(processes);
  this->Controller->AllGather(&length, lengths.data(), 1);
  begins.assign(1, 0);
  for (int i = 0; i < processes; ++i)
  {
    offsets[i] = static_cast<vtkIdType>(begins.back());
    begins.push_back(begins.back() + lengths[i]);
  }
  all.resize(begins.back());
  if (!all.empty())
  {
    this->Controller->AllGatherV(own.data(), all.data(), length, lengths.data(), offsets.data());
  }
}

void ControllerProcesses::minimum(std::vector<std::uint64_t>& values)
{
  if (values.empty())
  {
    return;
  }
  const std::vector<std::uint64_t> own = values;
  this->Controller->AllReduce(
    own.data(), values.data(), static_cast<vtkIdType>(values.size()), vtkCommunicator::MIN_OP);
}
}
