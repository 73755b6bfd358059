#include "svoSunBins.h"

#include "svoSunPosition.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <glm/trigonometric.hpp>

namespace svo
{
Date nextDay(const Date& date)
{
  if (isDate(date.year, date.month, date.day + 1))
  {
    return { date.year, date.month, date.day + 1 };
  }
  return date.month < 12 ? Date{ date.year, date.month + 1, 1 } : Date{ date.year + 1, 1, 1 };
}

std::string SunBins::Bin::name() const
{
  char text[64];
  if (this->suns > 1)
  {
    std::snprintf(text, sizeof(text), "azimuth %.1f, elevation %.1f", azimuthOf(this->sum),
      elevationOf(this->sum));
  }
  else
  {
    const int minutes = static_cast<int>(std::floor(this->hour * 60.0 + 1e-6));
    std::snprintf(text, sizeof(text), "%04d-%02d-%02d %02d:%02d", this->date.year, this->date.month,
      this->date.day, minutes / 60, minutes % 60);
  }
  return text;
}

void SunBins::add(const glm::dvec3& direction, double weight, const Date& date, double hour)
{
  const Bin alone{ direction * weight, weight, 1, date, hour };
  if (!(this->Width > 0.0))
  {
    this->Bins.push_back(alone);
    return;
  }
  const int ring = static_cast<int>(elevationOf(direction) / this->Width);
  const double around = 360.0 * std::cos(glm::radians((ring + 0.5) * this->Width));
  const int parts = std::max(1, static_cast<int>(std::ceil(around / this->Width)));
  const int part = static_cast<int>(azimuthOf(direction) / 360.0 * parts);
  const auto found = this->Places.emplace(std::make_pair(ring, part), this->Bins.size());
  if (found.second)
  {
    this->Bins.push_back(alone);
    return;
  }
  Bin& bin = this->Bins[found.first->second];
  bin.sum += alone.sum;
  bin.weight += weight;
  ++bin.suns;
}
}
