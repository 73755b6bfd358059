// Runs a test on every instruction set of this machine.
#ifndef svoInstructionSets_h
#define svoInstructionSets_h

#include <gtest/gtest.h>

#include <hwy/targets.h>

#include <cstdint>

namespace svotest
{
/// Calls f once for each instruction set that was compiled and that the machine has.
template <class F>
void onEveryInstructionSet(F&& f)
{
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
  {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    SCOPED_TRACE(hwy::TargetName(target));
    f();
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}
}

#endif
