// Suns of many hours and days, gathered where they stand close together.
#ifndef svoSunBins_h
#define svoSunBins_h

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
struct Date
{
  int year, month, day;
};

/// Of a date that exists.
Date nextDay(const Date& date);

class SunBins
{
public:
  struct Bin
  {
    glm::dvec3 sum; // of unit directions (east, north, up) times weights
    double weight;
    int suns;
    Date date; // of the first sun
    double hour;
    /// The time of a sun that is alone, "2024-06-21 12:15", else "azimuth 180.0, elevation 65.3".
    std::string name() const;
  };

  /// Degrees of arc; 0: each sun has a bin of its own.
  explicit SunBins(double width)
    : Width(width)
  {
  }
  void add(const glm::dvec3& direction, double weight, const Date& date, double hour);
  /// In the order of their first suns.
  const std::vector<Bin>& all() const { return this->Bins; }

private:
  double Width;
  std::vector<Bin> Bins;
  std::map<std::pair<int, int>, std::size_t> Places; // by ring of elevation, and part of the ring
};
}

#endif
