#include "svoSkyDirections.h"

#include <cmath>

namespace svo
{
std::vector<glm::dvec3> skyDirections(int count)
{
  const double turn = 3.14159265358979323846 * (3.0 - std::sqrt(5.0));
  std::vector<glm::dvec3> directions;
  for (int i = 0; i < count; ++i)
  {
    const double z = 1.0 - (i + 0.5) / count; // rings of equal area
    const double flat = std::sqrt(1.0 - z * z);
    directions.emplace_back(flat * std::cos(i * turn), flat * std::sin(i * turn), z);
  }
  return directions;
}

double overcastSky(double sine)
{
  return (1.0 + 2.0 * sine) / 3.0;
}
}
