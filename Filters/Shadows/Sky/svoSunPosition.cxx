#include "svoSunPosition.h"

#include <algorithm>
#include <cmath>

namespace svo
{
namespace
{
constexpr double Degree = 3.14159265358979323846 / 180.0;
double sine(double degrees)
{
  return std::sin(degrees * Degree);
}
double cosine(double degrees)
{
  return std::cos(degrees * Degree);
}
}

bool isDate(int year, int month, int day)
{
  constexpr int Days[] = { 31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31 };
  if (year < 1583 || year > 9999 || month < 1 || month > 12 || day < 1)
  {
    return false;
  }
  const bool leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  return day <= Days[month - 1] + (leap && month == 2 ? 1 : 0);
}

double julianDay(int year, int month, int day, double hour)
{
  const int y = month > 2 ? year : year - 1;
  const int m = month > 2 ? month : month + 12;
  const int century = y / 100;
  return std::floor(365.25 * (y + 4716)) + std::floor(30.6001 * (m + 1)) + day +
    (2 - century + century / 4) - 1524.5 + hour / 24.0;
}

SunPlace sunPlace(double julianDay)
{
  const double t = (julianDay - 2451545.0) / 36525.0; // centuries
  const double meanLongitude = 280.46646 + t * (36000.76983 + t * 0.0003032);
  const double anomaly = 357.52911 + t * (35999.05029 - t * 0.0001537);
  const double centre = sine(anomaly) * (1.914602 - t * (0.004817 + t * 0.000014)) +
    sine(2.0 * anomaly) * (0.019993 - t * 0.000101) + sine(3.0 * anomaly) * 0.000289;
  const double node = 125.04 - 1934.136 * t;
  const double longitude = meanLongitude + centre - 0.00569 - 0.00478 * sine(node);
  const double meanObliquity =
    23.0 + (26.0 + (21.448 - t * (46.815 + t * (0.00059 - t * 0.001813))) / 60.0) / 60.0;
  const double obliquity = meanObliquity + 0.00256 * cosine(node);
  const double rightAscension =
    std::atan2(cosine(obliquity) * sine(longitude), cosine(longitude)) / Degree;
  return { rightAscension < 0.0 ? rightAscension + 360.0 : rightAscension,
    std::asin(sine(obliquity) * sine(longitude)) / Degree };
}

glm::dvec3 sunDirection(double julianDay, double latitude, double longitude)
{
  const SunPlace sun = sunPlace(julianDay);
  const double days = julianDay - 2451545.0;
  const double t = days / 36525.0;
  const double node = 125.04 - 1934.136 * t;
  const double sidereal = 280.46061837 + 360.98564736629 * days + 0.000387933 * t * t -
    0.00478 * sine(node) * cosine(23.4393);
  const double hourAngle = sidereal + longitude - sun.rightAscension;
  const double up = sine(latitude) * sine(sun.declination) +
    cosine(latitude) * cosine(sun.declination) * cosine(hourAngle);
  const double north = cosine(latitude) * sine(sun.declination) -
    sine(latitude) * cosine(sun.declination) * cosine(hourAngle);
  return { -cosine(sun.declination) * sine(hourAngle), north, up };
}

double azimuthOf(const glm::dvec3& direction)
{
  const double azimuth = std::atan2(direction.x, direction.y) / Degree;
  return azimuth < 0.0 ? azimuth + 360.0 : azimuth;
}

double elevationOf(const glm::dvec3& direction)
{
  return std::atan2(direction.z, std::hypot(direction.x, direction.y)) / Degree;
}

double refraction(double elevation)
{
  const double h = elevation;
  const double tangent = std::tan(h * Degree);
  double seconds = 0.0;
  if (h > 85.0)
  {
    seconds = 0.0;
  }
  else if (h > 5.0)
  {
    seconds = 58.1 / tangent - 0.07 / std::pow(tangent, 3) + 0.000086 / std::pow(tangent, 5);
  }
  else if (h > -0.575)
  {
    seconds = 1735.0 + h * (-518.2 + h * (103.4 + h * (-12.79 + h * 0.711)));
  }
  else
  {
    seconds = -20.772 / tangent;
  }
  return seconds / 3600.0;
}

glm::dvec3 refracted(const glm::dvec3& direction)
{
  const double flat = std::hypot(direction.x, direction.y);
  if (!(flat > 0.0))
  {
    return direction;
  }
  const double elevation = elevationOf(direction);
  const double lifted = std::min(elevation + refraction(elevation), 90.0);
  return { direction.x / flat * cosine(lifted), direction.y / flat * cosine(lifted), sine(lifted) };
}
}
