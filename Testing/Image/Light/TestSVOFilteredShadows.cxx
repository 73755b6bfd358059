// With anti-aliasing the texels of a shadow buffer are not seen, however large they are: on a
// traced ground (left) and on a rasterised one (right).
#include "svoTestStage.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

namespace
{
using namespace svotest;

constexpr int Edge = 300; // pixels of each half

/// A box that stands on the ground, a ball that lies on it, a ring above it.
vtkActor* fill(Stage& stage)
{
  vtkActor* ground = stage.addGround(2.5);
  vtkActor* standing = stage.add(box(0.9, 0.0, 0.0, 0.45), 0.9, 0.5, 0.3);
  standing->SetPosition(-0.9, 0.3, 0.0);
  standing->RotateZ(25.0);
  stage.add(ball(0.4, 0.9, -0.6, 0.4), 0.4, 0.8, 0.5);
  vtkActor* floating = stage.add(ring(0.5, 0.0, 0.0, 0.0), 0.3, 0.6, 0.9);
  floating->SetPosition(0.7, 0.9, 0.9);
  floating->RotateY(20.0);
  // Always rasterised, and in part below the ground, so that both halves have the same shadow
  // buffers: whole, with the ground among the casters.
  vtkSVORenderPass::SetUseSVO(false, stage.add(ball(0.15, -0.3, -1.4, 0.12), 0.9, 0.8, 0.2));
  stage.addSun(1.5, -1.0, 2.5);
  stage.pass->SetShadowBufferResolution(128);
  return ground;
}

/// Half of a picture.
Picture cut(const Picture& p, int half)
{
  Picture result;
  result.width = Edge;
  result.height = p.height;
  for (int y = 0; y < p.height; ++y)
  {
    const std::size_t first = static_cast<std::size_t>(y) * p.width + half * Edge;
    result.rgb.insert(
      result.rgb.end(), p.rgb.begin() + 3 * first, p.rgb.begin() + 3 * (first + Edge));
    result.depth.insert(
      result.depth.end(), p.depth.begin() + first, p.depth.begin() + first + Edge);
  }
  return result;
}

struct Pictures
{
  Picture unshadowed, exact, hard, filtered;
  Mask ground; // pixels of the ground that light reaches, away from all edges of surfaces
  /// The share of the light that is left, 0..1.
  double lit(const Picture& p, std::size_t i) const { return p.grey(i) / this->unshadowed.grey(i); }
  /// 1 or 0 if the exact picture is lit or dark for so many pixels around, else -1.
  int plain(std::size_t i, int radius) const
  {
    const int x = static_cast<int>(i) % Edge, y = static_cast<int>(i) / Edge;
    const bool lit = this->lit(this->exact, i) > 0.5;
    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, this->exact.height - 1); ++v)
    {
      for (int u = std::max(x - radius, 0); u <= std::min(x + radius, Edge - 1); ++u)
      {
        const std::size_t k = static_cast<std::size_t>(v) * Edge + u;
        if (this->ground[k] && (this->lit(this->exact, k) > 0.5) != lit)
        {
          return -1;
        }
      }
    }
    return lit ? 1 : 0;
  }
};

void judge(const std::string& name, const Pictures& p, Checks& checks)
{
  double hardSquares = 0.0, squares = 0.0;
  std::size_t pixels = 0, hardSteps = 0, steps = 0, wrong = 0;
  for (std::size_t i = 0; i + Edge < p.ground.size(); ++i)
  {
    if (!p.ground[i])
    {
      continue;
    }
    ++pixels;
    const double exact = p.lit(p.exact, i), filtered = p.lit(p.filtered, i);
    hardSquares += std::pow(p.lit(p.hard, i) - exact, 2);
    squares += std::pow(filtered - exact, 2);
    for (std::size_t next : { i + 1, i + Edge })
    {
      if (p.ground[next])
      {
        hardSteps += std::abs(p.lit(p.hard, next) - p.lit(p.hard, i)) > 0.75;
        steps += std::abs(p.lit(p.filtered, next) - filtered) > 0.75;
      }
    }
    // A texel is up to six pixels wide here: light that leaks, halos, softened contact.
    const int plain = p.plain(i, 12);
    wrong += plain >= 0 && std::abs(filtered - plain) > 0.02;
  }
  std::cout << name << ": " << pixels << " pixels of ground; error "
            << std::sqrt(hardSquares / pixels) << " without, " << std::sqrt(squares / pixels)
            << " with the filter; steps " << hardSteps << ", " << steps << "; " << wrong
            << " wrong far from the shadow's edge\n";
  checks.expect(pixels > 15000, name + ": the ground is seen");
  checks.expect(hardSteps > 300, name + ": without the filter there are steps");
  checks.expect(steps == 0, name + ": with it there are none");
  checks.expect(squares < 0.7 * hardSquares, name + ": the filtered shadow is nearer to the truth");
  checks.expect(wrong == 0, name + ": no light leaks, and no halo darkens what is lit");
}
}

int TestSVOFilteredShadows(int argc, char* argv[])
{
  Checks checks;
  Stage left(2 * Edge, Edge);
  left.renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  Stage right(left, 0.5, 0.0, 1.0, 1.0);
  fill(left);
  vtkSVORenderPass::SetUseSVO(false, fill(right));

  const auto capture = [&](bool antiAliasing, auto technique)
  {
    for (Stage* stage : { &left, &right })
    {
      stage->pass->SetAntiAliasing(antiAliasing);
      technique(stage->pass.Get());
    }
    return svotest::capture(left.window);
  };
  const Picture unshadowed =
    capture(false, [](vtkSVORenderPass* pass) { pass->SetShadowTechniqueToNone(); });
  const Picture exact =
    capture(false, [](vtkSVORenderPass* pass) { pass->SetShadowTechniqueToShadowRays(); });
  const auto buffer = [](vtkSVORenderPass* pass) { pass->SetShadowTechniqueToShadowBuffer(); };
  const Picture hard = capture(false, buffer);
  const Picture filtered = capture(true, buffer);
  left.expectTraced(checks, 4, "left all is traced");
  right.expectTraced(checks, 3, "right the ground is not");
  const bool same = matchesBaseline(left.window, argc, argv);

  Pictures halves[2];
  for (int half = 0; half < 2; ++half)
  {
    Pictures& p = halves[half];
    p.unshadowed = cut(unshadowed, half);
    p.exact = cut(exact, 0); // no rays go from rasterised surfaces
    p.hard = cut(hard, half);
    p.filtered = cut(filtered, half);
    p.ground = awayFromEdges(p.unshadowed, 2);
    for (std::size_t i = 0; i < p.ground.size(); ++i)
    {
      const unsigned char* rgb = p.unshadowed.rgb.data() + 3 * i;
      // The ground alone is nearly grey.
      p.ground[i] = p.ground[i] && p.unshadowed.depth[i] < 1.0f && std::abs(rgb[0] - rgb[1]) < 4 &&
        rgb[1] - rgb[2] < 24 && rgb[0] > 100;
    }
    judge(half == 0 ? "traced" : "rasterised", p, checks);
  }
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < halves[0].ground.size(); ++i)
  {
    if (halves[0].ground[i] && halves[1].ground[i])
    {
      sum += std::abs(halves[0].filtered.grey(i) - halves[1].filtered.grey(i));
      ++count;
    }
  }
  std::cout << "the halves differ by " << sum / static_cast<double>(count) << " grey levels\n";
  checks.expect(sum < 1.0 * static_cast<double>(count), "both halves look alike");
  return checks.exitCode() || !same;
}
