// How far apart the rays of an interactive frame are, so that it takes no longer than it may.
#ifndef svoSampleDistance_h
#define svoSampleDistance_h

#include <cmath>

namespace svo
{
/// Pixels from one ray to the next, 1 or more. It follows the time that frames took: most of that
/// is in proportion to the number of rays.
class SampleDistance
{
public:
  /// For a frame that may take `budget` seconds.
  double choose(double budget, double maximum)
  {
    if (this->Seconds > 0.0)
    {
      const double needed = this->Distance * std::sqrt(this->Seconds / budget);
      // Finer only with time to spare, so that it does not change back and forth.
      if (needed > this->Distance || needed < 0.75 * this->Distance)
      {
        this->Distance = std::ceil(2.0 * needed) / 2.0;
      }
      this->Seconds = 0.0;
    }
    this->Distance = std::fmin(std::fmax(this->Distance, 1.0), maximum);
    return this->Distance;
  }

  /// What a frame with rays `distance` pixels apart took, if it was traced anew.
  void measured(double distance, double seconds)
  {
    this->Distance = distance;
    this->Seconds = seconds;
  }

private:
  double Distance = 1.0;
  double Seconds = 0.0; // of the last frame; 0: none
};
}

#endif
