// The window of a shadow buffer's texels around a point, and their weights.
#ifndef svoShadowFilter_h
#define svoShadowFilter_h

#include "svoShadowRules.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace svo
{
/// Along one axis of a map: what a box around the point, its edges blurred by a texel, covers of
/// each texel. The weights and their slopes change smoothly as the point moves, so that no step of
/// a texel is left to be seen; a box of one texel makes them a quadratic B-spline. They add up to
/// 1; texels beyond the border of the map have no part in it, as nobody knows what they would say.
class TexelWindow
{
public:
  static constexpr int Most = static_cast<int>(WidestBox) + 2; // texels in the window
  int first;                                                   // texel
  int count;
  double weight[Most]; // set by weigh()

  /// `place`: texels, in a map that has those from `begin` to before `end`, which begins at 0 or
  /// later. `width` of the box: 1..WidestBox texels.
  TexelWindow(double place, double width, int begin, int end)
    : Place(place)
    , Width(width)
  {
    assert(place >= begin && place < end && width >= 1.0 && width <= WidestBox);
    const double half = 0.5 * (width + 1.0);
    const int last = static_cast<int>(place + half); // truncated: it is not negative
    this->first = place > begin + half ? static_cast<int>(place - half) : begin;
    this->count = std::min({ last, end - 1, this->first + Most - 1 }) + 1 - this->first;
    assert(this->count > 0);
  }

  void weigh()
  {
    double sum = 0.0;
    double before = this->covered(this->first);
    for (int i = 0; i < this->count; ++i)
    {
      const double now = this->covered(this->first + i + 1);
      this->weight[i] = now - before;
      sum += this->weight[i];
      before = now;
    }
    for (int i = 0; i < this->count; ++i)
    {
      this->weight[i] /= sum;
    }
  }

private:
  /// Of the blurred box, what lies below x.
  double covered(double x) const
  {
    const double from = std::abs(x - this->Place);
    const double beyond = std::max(0.5 * (this->Width + 1.0) - from, 0.0);
    const double part = from <= 0.5 * (this->Width - 1.0)
      ? from / this->Width
      : 0.5 - 0.5 * beyond * beyond / this->Width;
    return x < this->Place ? 0.5 - part : 0.5 + part;
  }

  double Place, Width;
};
}

#endif
