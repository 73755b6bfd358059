// The five scenes of Huang & Cheng's experiments 1 to 4, as data.
#include "experiments.h"

#include <vtkMath.h>

#include <cmath>

namespace paper
{
namespace
{
/// One A in the middle, the others around its back in an arc of 240 degrees, looking at it.
std::vector<Placement> amphitheatre(int others, double radius)
{
  std::vector<Placement> result{ { 0, 0, 0, 1.3 } };
  for (int i = 0; i < others; ++i)
  {
    const double degrees = -30 + 240.0 * i / (others - 1);
    const double radians = vtkMath::RadiansFromDegrees(degrees);
    // A looks along -y at heading 0.
    result.push_back({ radius * std::cos(radians), radius * std::sin(radians), degrees - 90, 1 });
  }
  return result;
}
}

const std::vector<Experiment>& experiments()
{
  static const std::vector<Experiment> all{
    { "paper1a", "A", { { 0, 0, 20, 1 } }, {},
      { { "front", { 0.3, -1.8, 0.82 }, { 0, 0, 0.49 }, 30 },
        { "above", { -1.0, -1.1, 1.55 }, { 0, 0, 0.48 }, 29.5 },
        { "low", { 1.22, -1.27, 0.25 }, { 0, 0, 0.5 }, 31 } },
      { -1.0, -2.4, 3.2 }, "16-18", {} },
    { "paper1b", "B", {}, { { 0, 0 }, 0.12, -235, 1, 0.04 },
      { { "front", { 0.3, -0.85, 0.75 }, { 0.02, -0.05, 0.6 }, 18.8 },
        { "above", { -0.48, -0.5, 1.1 }, { 0, 0, 0.6 }, 18.8 },
        { "low", { 0.45, -0.6, 0.2 }, { 0, 0, 0.58 }, 19 } },
      { -0.8, -1.8, 2.6 }, "18-22",
      { { "front", { 0.4, -1.75, 0.85 }, { 0.05, 0, 0.5 }, 32 },
        { "above", { -1.0, -1.3, 1.7 }, { 0.1, 0.1, 0.42 }, 32 },
        { "low", { 1.15, -1.4, 0.25 }, { 0, 0, 0.46 }, 33 } } },
    { "paper2", "2 A + B", { { -0.68, 0.1, 0, 1.15 }, { 0.72, 0.15, -20, 1.15 } },
      { { 0.05, -0.35 }, 0.35, 40, 1, 1 },
      { { "front", { 0.2, -2.75, 1.05 }, { 0.03, 0, 0.53 }, 28 },
        { "above", { -1.2, -1.9, 2.0 }, { 0, 0, 0.45 }, 29 },
        { "low", { 1.1, -2.1, 0.35 }, { 0.05, 0, 0.53 }, 30 } },
      { -1.2, -2.8, 3.6 }, "10-13", {} },
    { "paper3", "6 A + B", amphitheatre(5, 1.4), { { 0, 0 }, 0.75, 188, 1.1, 1 },
      { { "front", { 0.2, -3.7, 1.6 }, { 0, 0.2, 0.45 }, 30 },
        { "above", { -2.0, -2.4, 2.8 }, { 0, 0.2, 0.3 }, 31 },
        { "low", { 1.5, -3.0, 0.7 }, { 0, 0.2, 0.5 }, 32 } },
      { -1.4, -2.9, 4.0 }, "5-8", {} },
    { "paper4", "9 A + B", amphitheatre(8, 1.6), { { 0, 0 }, 0.8, 188, 1.1, 1 },
      { { "front", { 0.2, -4.0, 1.9 }, { 0, 0.2, 0.4 }, 30 },
        { "above", { -2.2, -2.6, 3.2 }, { 0, 0.2, 0.3 }, 32 },
        { "low", { 1.7, -3.2, 0.8 }, { 0, 0.2, 0.5 }, 32 } },
      { -1.4, -2.9, 4.2 }, "5-6", {} }
  };
  return all;
}
}
