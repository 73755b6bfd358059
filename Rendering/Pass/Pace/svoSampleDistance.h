// The distance between the rays of an interactive frame, chosen so that the frame keeps to its
// time.
#ifndef svoSampleDistance_h
#define svoSampleDistance_h

#include <algorithm>
#include <cmath>

namespace svo
{
/// The time of a frame, in seconds.
struct FrameCost
{
  double fixed = 0.0; // whatever the number of rays
  double rays = 0.0;  // if there is a ray for each pixel; in proportion to their number
};

/// Pixels from one ray to the next, 1 or more. It follows the times of frames, and weighs only the
/// part of them that grows with the number of rays.
class SampleDistance
{
public:
  /// For a frame that may take `budget` seconds together with the `others` of its window, whose
  /// rays are as far apart.
  double choose(double budget, double maximum, const FrameCost& others = {})
  {
    if (this->Measured)
    {
      // Where the rest takes all of the time, rays that take a quarter of it do no harm.
      const double left = std::max(budget - this->Cost.fixed - others.fixed, 0.25 * budget);
      const double needed = std::sqrt((this->Cost.rays + others.rays) / left);
      // Finer only with time to spare, so that it does not change back and forth.
      if (needed > this->Distance || needed < 0.75 * this->Distance)
      {
        this->Distance = std::ceil(2.0 * needed) / 2.0;
      }
      this->Measured = false;
    }
    this->Distance = std::fmin(std::fmax(this->Distance, 1.0), maximum);
    return this->Distance;
  }

  /// What a frame with rays `distance` pixels apart took, if it was traced anew: `seconds`, of
  /// which `fixed` do not depend on the rays.
  void measured(double distance, double seconds, double fixed = 0.0)
  {
    this->Distance = distance;
    this->Cost = { fixed, distance * distance * std::max(seconds - fixed, 0.0) };
    this->Measured = true;
  }

  /// Of the frame that was measured last.
  const FrameCost& cost() const { return this->Cost; }

private:
  double Distance = 1.0;
  FrameCost Cost;
  bool Measured = false; // and not yet taken into account
};
}

#endif
