// Where the sun stands, by date, time and place.
//
// J. Meeus, "Astronomical Algorithms", 2nd edition 1998: Julian day (chapter 7), sidereal time
// (12), the sun's apparent place with low accuracy (25: 0.01 degrees), parallax left out (0.0024
// degrees); the difference of terrestrial time and UTC, about a minute, is left out as well (0.0007
// degrees). NOAA's solar calculator has the same place of the sun. Good for 1900 to 2100.
#ifndef svoSunPosition_h
#define svoSunPosition_h

#include <glm/vec3.hpp>

namespace svo
{
/// True for a day that the Gregorian calendar has, of a year from 1583 on to 9999.
bool isDate(int year, int month, int day);

/// Days since noon of 1 January 4713 BC, UTC. The hour may be any: 25 is one o'clock of the next
/// day.
double julianDay(int year, int month, int day, double hour);

/// The sun's apparent place, degrees.
struct SunPlace
{
  double rightAscension;
  double declination;
};
SunPlace sunPlace(double julianDay);

/// The unit direction from a place on earth to the sun: x east, y north, z up. Latitude and
/// longitude in degrees, north and east positive. Geometric: without refraction.
glm::dvec3 sunDirection(double julianDay, double latitude, double longitude);

/// Of a direction (east, north, up), degrees: from north to east, 0 to 360; and above the horizon.
double azimuthOf(const glm::dvec3& direction);
double elevationOf(const glm::dvec3& direction);

/// By how much air lifts what is at this geometric elevation; all in degrees. For 1010 hPa and 10
/// degrees Celsius; NOAA's approximation.
double refraction(double elevation);

/// The same direction, lifted by refraction.
glm::dvec3 refracted(const glm::dvec3& direction);
}

#endif
