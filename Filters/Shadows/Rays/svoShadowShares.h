// Which share of each place is in the shadow of each light, and what arrives of all.
#ifndef svoShadowShares_h
#define svoShadowShares_h

#include "svoHiddenSamples.h"
#include "svoLight.h"
#include "svoParallel.h"
#include "svoSamples.h"

#include <atomic>
#include <functional>
#include <vector>

namespace svo
{
struct WeightedLight
{
  Light light;
  double weight = 1.0;
  double cone = -2.0; // the cosine of its half angle, or -2 where there is none
  bool on = true;     // nothing arrives of one that is not
};

struct ShareOptions
{
  bool twoSided = false;   // what faces away from a light is asked for on its other side
  bool cosine = false;     // what arrives counts by the cosine of its incidence
  bool singleRays = false; // see hiddenSamples()
  ParallelFor parallelFor = serialFor;
  /// Called now and then on the calling thread with 0..1; false aborts.
  std::function<bool(double)> progress;
};

/// Where the answers go, by the ids of places; those in no piece are left as they are. `shadow` has
/// a value for each light, light by light for one place, then for the next; it may be null, and so
/// may `faced`.
struct ShareArrays
{
  float* shadow = nullptr;
  double* exposure = nullptr;
  std::atomic<bool>* faced = nullptr; // set where a place faces a light that is on, in its cone
};

/// True unless it was aborted. The answers do not depend on the number of threads. A place gets
/// nothing, which counts as shadow, of a light that is off, whose cone it is out of, that it faces
/// away from (but with `twoSided`), or that a caster hides.
bool computeShadowShares(const Samples& samples, const RayCasters& casters, const OwnMesh& own,
  const std::vector<WeightedLight>& lights, const ShareOptions& options, const ShareArrays& out);
}

#endif
