#include "svoEvenPoints.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
/// More points than this stay on the lattice, whose error is larger by a tenth to a sixth.
constexpr std::size_t MostMoved = 256;

constexpr int Steps = 45; // more gain a hundredth at most, and lose along edges

/// Length of a step for a force of 1, and what is left of the last one: far from where it swings.
constexpr double StepLength = 0.3, Momentum = 0.8;

using Corners = std::vector<glm::dvec2>; // counterclockwise

/// The gradient of the mean distance to a shape's points: by Gauss' theorem the distance to its
/// edges, times their normals.
glm::dvec2 distanceGradient(const Corners& shape, double area, const glm::dvec2& x)
{
  glm::dvec2 sum(0.0);
  for (std::size_t i = 0; i < shape.size(); ++i)
  {
    const glm::dvec2 begin = shape[i] - x;
    const glm::dvec2 edge = shape[(i + 1) % shape.size()] - shape[i];
    const double length = glm::length(edge);
    const glm::dvec2 along = edge / length, out(along.y, -along.x);
    const double away = std::max(std::abs(glm::dot(begin, out)), 1e-12);
    const auto integral = [away](double s)
    { return 0.5 * (s * std::hypot(s, away) + away * away * std::asinh(s / away)); };
    const double first = glm::dot(begin, along);
    sum -= (integral(first + length) - integral(first)) * out;
  }
  return sum / area;
}

/// Moves points to where the energy distance is small.
void spread(const Corners& shape, double area, std::vector<glm::dvec2>& points)
{
  const std::size_t count = points.size();
  std::vector<glm::dvec2> moves(count, glm::dvec2(0.0)), apart(count);
  for (int step = 0; step < Steps; ++step)
  {
    std::fill(apart.begin(), apart.end(), glm::dvec2(0.0));
    for (std::size_t i = 0; i < count; ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        const glm::dvec2 way = points[i] - points[j];
        const glm::dvec2 unit = way / std::sqrt(way.x * way.x + way.y * way.y + 1e-24);
        apart[i] += unit;
        apart[j] -= unit;
      }
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      const glm::dvec2 gradient =
        distanceGradient(shape, area, points[i]) - apart[i] / static_cast<double>(count);
      moves[i] = Momentum * moves[i] - StepLength * gradient;
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      points[i] += moves[i];
    }
  }
}
}

glm::dvec2 EvenPoints::onLattice(std::size_t index, std::size_t count) const
{
  constexpr double Golden = 0.61803398874989485;
  const double along = (static_cast<double>(index) + 0.5) / static_cast<double>(count);
  const double turns = (static_cast<double>(index) + 0.5) * Golden;
  const double across = turns - std::floor(turns);
  if (this->Of == Shape::Square)
  {
    return { along, across };
  }
  // E. Heitz, "A low-distortion map between triangle and square", 2019: each half is sheared.
  return across > along ? glm::dvec2(0.5 * along, across - 0.5 * along)
                        : glm::dvec2(along - 0.5 * across, 0.5 * across);
}

void EvenPoints::prepare(std::size_t count)
{
  if (count < 2 || count > MostMoved || this->Kept.count(count) > 0)
  {
    return;
  }
  std::vector<glm::dvec2>& points = this->Kept[count];
  for (std::size_t i = 0; i < count; ++i)
  {
    points.push_back(this->onLattice(i, count));
  }
  if (this->Of == Shape::Square)
  {
    spread({ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }, 1.0, points);
    return;
  }
  const double height = std::sqrt(0.75);
  for (glm::dvec2& p : points)
  {
    p = { p.x + 0.5 * p.y, height * p.y };
  }
  spread({ { 0, 0 }, { 1, 0 }, { 0.5, height } }, 0.5 * height, points);
  for (glm::dvec2& p : points)
  {
    p = { p.x - 0.5 * p.y / height, p.y / height };
  }
}

glm::dvec2 EvenPoints::at(std::size_t index, std::size_t count) const
{
  if (count == 1)
  {
    return glm::dvec2(this->Of == Shape::Square ? 0.5 : 1.0 / 3.0);
  }
  const auto kept = this->Kept.find(count);
  return kept == this->Kept.end() ? this->onLattice(index, count) : kept->second[index];
}
}
