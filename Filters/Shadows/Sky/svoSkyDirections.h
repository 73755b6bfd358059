// Directions spread evenly over the hemisphere, and how bright a sky is there.
#ifndef svoSkyDirections_h
#define svoSkyDirections_h

#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
/// Unit directions to the middles of `count` equal parts of the hemisphere above z = 0, along the
/// spiral of the golden angle (J. H. Hannay, J. F. Nye, "Fibonacci numerical integration on a
/// sphere", J. Phys. A 37, 2004).
std::vector<glm::dvec3> skyDirections(int count);

/// Brightness of the standard overcast sky relative to its zenith (P. Moon, D. E. Spencer, 1942;
/// CIE S 011, sky type 16): a third as bright at the horizon. `sine`: of the elevation.
double overcastSky(double sine);
}

#endif
