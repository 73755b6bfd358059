// How far a picture is from a still one, over the pixels that this one covers.
#ifndef pictureDifference_h
#define pictureDifference_h

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <vector>

namespace performance
{
struct PictureDifference
{
  double mean = 0.0;  // of a channel, 0..255
  double wrong = 0.0; // share of the pixels that differ by more than 8 in some channel

  /// RGB, of as many pixels. What is black is not covered.
  PictureDifference(
    const std::vector<unsigned char>& still, const std::vector<unsigned char>& quick)
  {
    constexpr int Visible = 8;
    int covered = 0;
    for (std::size_t i = 0; i < still.size(); i += 3)
    {
      int most = 0;
      for (std::size_t c = i; c < i + 3; ++c)
      {
        most = std::max(most, std::abs(still[c] - quick[c]));
        this->mean += std::abs(still[c] - quick[c]) / 3.0;
      }
      this->wrong += most > Visible;
      covered += still[i] + still[i + 1] + still[i + 2] > 0;
    }
    this->mean /= covered;
    this->wrong /= covered;
  }
};
}

#endif
