// How many more samples of its lights a picture that stays gets at a time.
#ifndef svoSampleStep_h
#define svoSampleStep_h

#include <algorithm>

namespace svo
{
/// To `shown` ones at most as many again, and, one after the other, no more than take so many
/// seconds, but one at least. `each`: what one takes; 0: nobody knows.
inline int moreSamples(int shown, double each, double seconds)
{
  return each > 0.0 && seconds < shown * each ? std::max(1, static_cast<int>(seconds / each))
                                              : shown;
}
}

#endif
