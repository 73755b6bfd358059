// How much of what is random a test looks at: little by default, and SVO_RANDOM_SCENES of it in the
// tests labelled "long".
#ifndef svoRandomScenes_h
#define svoRandomScenes_h

#include <cstdlib>

namespace svotest
{
/// True if more is asked for than what an ordinary run has time for.
inline bool isThorough()
{
  return std::getenv("SVO_RANDOM_SCENES") != nullptr;
}

/// The number of scenes, or of steps: `few`, unless others are asked for.
inline unsigned scenesOr(unsigned few)
{
  return isThorough() ? static_cast<unsigned>(std::atoi(std::getenv("SVO_RANDOM_SCENES"))) : few;
}
}

#endif
