// The distance between the rays of an interactive frame, and how coarse its shadow maps are, chosen
// so that the frame keeps to its time.
//
// Shadow maps of lights that move with the camera are traced in every frame, and often take more
// time than the picture itself. So they are the first to become coarser, since a blurred edge of a
// shadow is seen less than a blurred picture; rays move apart when maps of the coarsest kind still
// take too long. Maps that take a small share of the time stay as they are.
#ifndef svoSampleDistance_h
#define svoSampleDistance_h

#include <algorithm>
#include <cmath>

namespace svo
{
/// The time of a frame, in seconds.
struct FrameCost
{
  double fixed = 0.0;   // whatever the number of rays
  double rays = 0.0;    // if there is a ray for each pixel; in proportion to their number
  double shadows = 0.0; // of maps with all their texels; in proportion to the number of texels
};

/// How a frame is traced, or was.
struct FramePace
{
  double distance = 1.0;   // pixels from one ray to the next, 1 or more
  double coarseness = 1.0; // texels of shadow maps that one of them stands for, along an edge
};

/// It follows the times of frames, and weighs only those parts of them that grow with the number of
/// rays and of texels.
class SampleDistance
{
public:
  /// For a frame that may take `budget` seconds together with the `others` of its window, whose
  /// rays are as far apart. `maximum`: of either number.
  FramePace choose(double budget, double maximum, const FrameCost& others = {})
  {
    if (this->Measured)
    {
      // Where the rest takes all of the time, rays that take a quarter of it do no harm.
      const double least = 0.25 * budget;
      const double left = std::max(budget - this->Cost.fixed - others.fixed, least);
      const double rays = this->Cost.rays + others.rays;
      const double shadows = this->Cost.shadows + others.shadows;
      // What maps have in any case: to make them coarser would save little.
      const double kept =
        std::max(std::min(shadows, SmallShare * left), shadows / (maximum * maximum));
      follow(std::sqrt(rays / std::max(left - kept, least)), maximum, this->Pace.distance);
      const double forRays = rays / (this->Pace.distance * this->Pace.distance);
      follow(std::sqrt(shadows / std::max({ left - forRays, kept, 1e-9 })), maximum,
        this->Pace.coarseness);
      this->Measured = false;
    }
    this->Pace.distance = std::fmin(std::fmax(this->Pace.distance, 1.0), maximum);
    this->Pace.coarseness = std::fmin(std::fmax(this->Pace.coarseness, 1.0), maximum);
    return this->Pace;
  }

  /// What a frame at a pace took, if it was traced anew: `seconds`, of which `fixed` depend neither
  /// on the rays nor on the texels, and `shadows` on the texels alone.
  void measured(const FramePace& pace, double seconds, double fixed = 0.0, double shadows = 0.0)
  {
    this->Pace = pace;
    this->Cost = { fixed, pace.distance * pace.distance * std::max(seconds - fixed - shadows, 0.0),
      pace.coarseness * pace.coarseness * shadows };
    this->Measured = true;
  }

  /// Of the frame that was measured last.
  const FrameCost& cost() const { return this->Cost; }

private:
  /// Share of the time for rays and maps that maps may always have.
  static constexpr double SmallShare = 1.0 / 16.0;

  /// Finer only with time to spare, so that nothing changes back and forth.
  static void follow(double needed, double maximum, double& value)
  {
    if (needed > value || needed < 0.75 * value)
    {
      value = std::fmin(std::fmax(std::ceil(2.0 * needed) / 2.0, 1.0), maximum);
    }
  }

  FramePace Pace;
  FrameCost Cost;
  bool Measured = false; // and not yet taken into account
};
}

#endif
