#include "svoReceivers.h"

#include <cmath>

namespace svo
{
double differenceOf(const std::vector<std::uint16_t>& before, const std::vector<std::uint16_t>& now,
  const std::vector<int>& planes, const ReceiverPlaces& places)
{
  if (before.size() != now.size())
  {
    return -1.0;
  }
  const std::size_t pixels = places.places.size() / 4;
  double sum = 0.0;
  std::size_t count = 0;
  for (const int plane : planes)
  {
    const std::size_t first = 4 * pixels * (static_cast<std::size_t>(plane) / 4) + plane % 4;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
    {
      const std::size_t i = first + 4 * pixel;
      const bool surface = places.places[4 * pixel + 3] > ReceiverPlaces::Nowhere;
      const double difference = (static_cast<double>(now[i]) - before[i]) / 257.0;
      sum += surface ? difference * difference : 0.0;
      count += surface;
    }
  }
  return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
}
}
