// Whether a filter is to stop, for every version of VTK; and its progress.
#ifndef svoAbort_h
#define svoAbort_h

#include "vtkAlgorithm.h"
#include "vtkVersionMacros.h"

namespace svo
{
/// Up to VTK 9.2 an algorithm's own flag, which the next execution clears. VTK 9.3, and the VTK of
/// ParaView 5.11, asks the algorithms upstream as well; the executive then empties the output, and
/// executes again once the flag is cleared.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220816)
constexpr bool ExecutiveEmptiesAbortedOutput = true;
inline bool isAborted(vtkAlgorithm* algorithm)
{
  return algorithm->CheckAbort();
}
#else
constexpr bool ExecutiveEmptiesAbortedOutput = false;
inline bool isAborted(vtkAlgorithm* algorithm)
{
  return algorithm->GetAbortExecute() != 0;
}
#endif

/// Tells the algorithm's progress, 0..1; false if it is to stop.
inline bool goesOn(vtkAlgorithm* algorithm, double progress)
{
  algorithm->UpdateProgress(progress);
  return !isAborted(algorithm);
}
}

#endif
