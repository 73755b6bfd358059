#include "svoSkyPicture.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace svo
{
namespace
{
constexpr double Pi = 3.14159265358979323846;

/// Of an interval of sums: the one that x lies in, and where, 0..1.
int drawn(const float* ends, int count, float& x)
{
  const float* const after = std::upper_bound(ends + 1, ends + count, x);
  const int i = static_cast<int>(after - ends) - 1;
  const float width = ends[i + 1] - ends[i];
  x = width > 0.0f ? std::min((x - ends[i]) / width, 1.0f) : 0.5f;
  return i;
}

/// What SkyPicture::irradiance() is of, but for constants.
std::array<float, 9> harmonics(const glm::vec3& n)
{
  return { 1.0f, n.x, n.y, n.z, n.x * n.y, n.y * n.z, 3.0f * n.z * n.z - 1.0f, n.x * n.z,
    n.x * n.x - n.y * n.y };
}
}

SkyPicture::SkyPicture(int columns, int rows, const float* rgb, const glm::mat3& axes)
  : Columns(std::min(columns, MostColumns))
  , Rows(std::min(rows, MostRows))
  , Axes(axes)
{
  static std::atomic<std::uint64_t> last{ 0 };
  this->Version = ++last;
  const auto cells = static_cast<std::size_t>(this->Columns * this->Rows);
  std::vector<glm::dvec3> light(cells, glm::dvec3(0.0)); // over its solid angle
  for (int y = 0; y < rows; ++y)
  {
    const double solid = 2.0 * Pi / columns *
      (std::sin(Pi * ((y + 1.0) / rows - 0.5)) -
        std::sin(Pi * (static_cast<double>(y) / rows - 0.5)));
    const int row = static_cast<int>(static_cast<long>(y) * this->Rows / rows);
    for (int x = 0; x < columns; ++x)
    {
      const int column = static_cast<int>(static_cast<long>(x) * this->Columns / columns);
      for (int c = 0; c < 3; ++c, ++rgb)
      {
        constexpr float Most = 1e6f; // suns have less
        light[static_cast<std::size_t>(row * this->Columns + column)][c] +=
          *rgb > 0.0f ? solid * static_cast<double>(std::min(*rgb, Most)) : 0.0;
      }
    }
  }
  const auto largest = [](const glm::dvec3& v) { return std::max({ v.x, v.y, v.z }); };
  double total = 0.0;
  for (const glm::dvec3& cell : light)
  {
    total += largest(cell);
  }
  this->Brightest = static_cast<float>(total / Pi);
  // Where there is no light all directions are as good.
  const auto share = [&](double sum, double all, int i, int count)
  { return static_cast<float>(all > 0.0 ? sum / all : static_cast<double>(i) / count); };
  this->Table.resize(this->colorAt(this->Rows, 0));
  std::array<glm::dvec3, 9> sums{};
  double below = 0.0;
  for (int row = 0; row < this->Rows; ++row)
  {
    const glm::dvec3* const of = &light[static_cast<std::size_t>(row * this->Columns)];
    double all = 0.0, before = 0.0;
    std::for_each(of, of + this->Columns, [&](const glm::dvec3& cell) { all += largest(cell); });
    this->Table[static_cast<std::size_t>(row)] = share(below, total, row, this->Rows);
    below += all;
    float* const ends = const_cast<float*>(this->cellEnds(row));
    for (int column = 0; column < this->Columns; ++column)
    {
      const glm::dvec3& cell = of[column];
      ends[column] = share(before, all, column, this->Columns);
      before += largest(cell);
      for (int c = 0; c < 3; ++c)
      {
        this->Table[this->colorAt(row, column) + static_cast<std::size_t>(c)] =
          static_cast<float>(largest(cell) > 0.0 ? cell[c] / largest(cell) : 0.0);
      }
      constexpr int Parts = 4; // of a cell, squared, each of the same solid angle
      const double low = std::sin(Pi * (static_cast<double>(row) / this->Rows - 0.5));
      const double high = std::sin(Pi * ((row + 1.0) / this->Rows - 0.5));
      for (int part = 0; part < Parts * Parts; ++part)
      {
        const double z = low + (high - low) * (part / Parts + 0.5) / Parts;
        const double across = std::sqrt(std::max(1.0 - z * z, 0.0));
        const double longitude =
          2.0 * Pi * ((column + (part % Parts + 0.5) / Parts) / this->Columns - 0.5);
        const std::array<float, 9> h =
          harmonics(glm::vec3(across * std::cos(longitude), z, across * std::sin(longitude)));
        for (std::size_t k = 0; k < 9; ++k)
        {
          sums[k] += static_cast<double>(h[k]) / (Parts * Parts) * cell;
        }
      }
    }
    ends[this->Columns] = 1.0f;
  }
  this->Table[static_cast<std::size_t>(this->Rows)] = 1.0f;
  // Squares of the harmonics' norms, times how much of each degree the cosine leaves, by pi.
  constexpr double Norms[] = { 1.0 / 4, 3.0 / 4, 3.0 / 4, 3.0 / 4, 15.0 / 4, 15.0 / 4, 5.0 / 16,
    15.0 / 4, 15.0 / 16 };
  constexpr double Left[] = { 1.0, 2.0 / 3, 2.0 / 3, 2.0 / 3, 1.0 / 4, 1.0 / 4, 1.0 / 4, 1.0 / 4,
    1.0 / 4 };
  for (std::size_t k = 0; k < 9; ++k)
  {
    this->Irradiance[k] = glm::vec3(sums[k] * (Norms[k] / Pi * Left[k]));
  }
}

glm::vec3 SkyPicture::direction(const glm::vec2& square) const
{
  glm::vec2 at = square;
  const int row = drawn(this->rowEnds(), this->Rows, at.y);
  const int column = drawn(this->cellEnds(row), this->Columns, at.x);
  const auto pi = static_cast<float>(Pi);
  const float low =
    std::sin(pi * (static_cast<float>(row) / static_cast<float>(this->Rows) - 0.5f));
  const float high =
    std::sin(pi * (static_cast<float>(row + 1) / static_cast<float>(this->Rows) - 0.5f));
  const float up = glm::mix(low, high, at.y);
  const float longitude =
    2.0f * pi * ((static_cast<float>(column) + at.x) / static_cast<float>(this->Columns) - 0.5f);
  const float across = std::sqrt(std::max(1.0f - up * up, 0.0f));
  return this->Axes * glm::vec3(across * std::cos(longitude), up, across * std::sin(longitude));
}

glm::vec3 SkyPicture::share(const glm::vec3& direction, const glm::vec3& normal) const
{
  const auto pi = static_cast<float>(Pi);
  const glm::vec3 along = direction * this->Axes;
  const float longitude = std::atan2(along.z, along.x) / (2.0f * pi) + 0.5f;
  const float latitude = std::asin(std::clamp(along.y, -1.0f, 1.0f)) / pi + 0.5f;
  const int column = std::clamp(
    static_cast<int>(longitude * static_cast<float>(this->Columns)), 0, this->Columns - 1);
  const int row =
    std::clamp(static_cast<int>(latitude * static_cast<float>(this->Rows)), 0, this->Rows - 1);
  const float* const color = &this->Table[this->colorAt(row, column)];
  return std::max(glm::dot(direction, normal), 0.0f) * glm::vec3(color[0], color[1], color[2]);
}

glm::vec3 SkyPicture::over(const glm::vec3& normal) const
{
  const std::array<float, 9> h = harmonics(normal * this->Axes);
  glm::vec3 sum(0.0f);
  for (std::size_t k = 0; k < 9; ++k)
  {
    sum += h[k] * this->Irradiance[k];
  }
  return glm::max(sum, 0.0f);
}
}
