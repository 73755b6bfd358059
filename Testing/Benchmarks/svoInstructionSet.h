// Which instruction set the kernels take, of those that were compiled and that the machine has.
#ifndef svoInstructionSet_h
#define svoInstructionSet_h

#include <hwy/targets.h>

#include <cstdint>
#include <string>

namespace svobench
{
/// "AVX-512", "AVX2", "SSE4", "scalar", or "" for the best. False, and the best, if the machine
/// lacks it. Not while kernels run on other threads.
inline bool useInstructionSet(const std::string& name)
{
  struct Known
  {
    const char* name;
    std::int64_t targets;
  };
  constexpr Known known[] = { { "AVX-512", 2 * HWY_AVX3 - 1 }, { "AVX2", HWY_AVX2 },
    { "SSE4", HWY_SSE4 }, { "scalar", HWY_SCALAR } };
  hwy::DisableTargets(0);
  for (const Known& set : known)
  {
    if (name == set.name)
    {
      const bool there = (hwy::SupportedTargets() & set.targets) != 0;
      // Better sets have lower bits.
      hwy::DisableTargets(there ? (set.targets & -set.targets) - 1 : 0);
      return there;
    }
  }
  return name.empty();
}
}

#endif
