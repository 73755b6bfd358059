// Lights with a size on surfaces that VTK draws, which look them up in shadow maps of the CPU and
// of OpenGL: against closed forms of penumbras, and against rays of the CPU.
#include "svoTestStage.h"

#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkLightCollection.h"
#include "vtkPlaneSource.h"
#include "vtkProperty.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using namespace svotest;

const double Pi = std::acos(-1.0);

/// Of each pixel the share of light that is left; negative where it is not known.
using Shares = std::vector<double>;
using Fill = std::function<void(Stage&)>;

Shares sharesOf(const Picture& shadowed, const Picture& unshadowed, const Mask& mask)
{
  Shares shares;
  for (std::size_t i = 0; i < mask.size(); ++i)
  {
    const double all = unshadowed.grey(i);
    shares.push_back(mask[i] && all > 40.0 ? shadowed.grey(i) / all : -1.0);
  }
  return shares;
}

bool isBetween(double share)
{
  return share > 0.02 && share < 0.98;
}

/// RMS of what is off in penumbras, and of all pixels.
struct Error
{
  double penumbra = 0.0, all = 0.0;
  std::size_t penumbras = 0, pixels = 0;

  Error(const Shares& truth, const Shares& found)
  {
    for (std::size_t i = 0; i < truth.size(); ++i)
    {
      if (truth[i] >= 0.0 && found[i] >= 0.0)
      {
        const double off = std::pow(found[i] - truth[i], 2);
        this->all += off;
        ++this->pixels;
        this->penumbra += isBetween(truth[i]) ? off : 0.0;
        this->penumbras += isBetween(truth[i]);
      }
    }
    this->penumbra = std::sqrt(this->penumbra / std::max<double>(this->penumbras, 1.0));
    this->all = std::sqrt(this->all / std::max<double>(this->pixels, 1.0));
  }
};

/// Pixels that are not as light, or as dark, as all known ones so far around: acne, and leaks.
std::size_t wrongFarFromPenumbras(const Shares& truth, const Shares& found, int edge, int radius)
{
  std::size_t wrong = 0;
  for (int y = radius; y < edge - radius; ++y)
  {
    for (int x = radius; x < edge - radius; ++x)
    {
      const std::size_t i = static_cast<std::size_t>(y) * edge + x;
      bool plain = truth[i] >= 0.0 && found[i] >= 0.0;
      for (int k = 0; plain && k < (2 * radius + 1) * (2 * radius + 1); ++k)
      {
        const double there =
          truth[i + (k / (2 * radius + 1) - radius) * edge + k % (2 * radius + 1) - radius];
        plain = there < 0.0 || std::abs(there - std::round(truth[i])) < 0.02;
      }
      wrong += plain && std::abs(found[i] - truth[i]) > 0.03;
    }
  }
  return wrong;
}

/// The same scene by rays of the CPU, and drawn by VTK.
struct Ways
{
  Picture unshadowed, rays, sharp, maps, openGL;
};

Ways draw(const Fill& fill, double size, int edge)
{
  Ways ways;
  Stage stage(edge, edge);
  stage.pass->SetBackendToCPU();
  stage.pass->SetFilterShadows(true);
  stage.pass->SetMaximumLightSamples(256);
  fill(stage);
  auto* light = vtkLight::SafeDownCast(stage.renderer->GetLights()->GetItemAsObject(0));
  vtkSVORenderPass::SetLightSize(size, light);
  ways.rays = capture(stage.window);
  stage.pass->SetShadowTechniqueToNone();
  ways.unshadowed = capture(stage.window);
  stage.pass->SetShadowTechniqueToShadowBuffer();
  vtkCollectionSimpleIterator at;
  vtkActorCollection* actors = stage.renderer->GetActors();
  actors->InitTraversal(at);
  while (vtkActor* actor = actors->GetNextActor(at))
  {
    vtkSVORenderPass::SetUseSVO(false, actor);
  }
  vtkSVORenderPass::SetLightSize(0.0, light);
  ways.sharp = capture(stage.window);
  vtkSVORenderPass::SetLightSize(size, light);
  ways.maps = capture(stage.window);
  stage.pass->SetBackendToOpenGL();
  ways.openGL = capture(stage.window);
  return ways;
}

/// What RMS in penumbras may be, and in how small a part of what it is of sharp shadows.
struct Bars
{
  double penumbra, ofSharp;
};

Error judge(const std::string& name, const Ways& ways, const Shares& truth, const Mask& mask,
  const Bars& bars, Checks& checks)
{
  const auto errorOf = [&](const Picture& p)
  { return Error(truth, sharesOf(p, ways.unshadowed, mask)); };
  const Error sharp = errorOf(ways.sharp), maps = errorOf(ways.maps), openGL = errorOf(ways.openGL);
  std::cout << name << ": " << maps.penumbras << " of " << maps.pixels
            << " pixels in penumbras; RMS there " << maps.penumbra << ", of OpenGL's maps "
            << openGL.penumbra << ", sharp " << sharp.penumbra << "; of all " << maps.all << ", "
            << openGL.all << ", " << sharp.all << "\n";
  checks.expect(maps.penumbras > 25, name + ": there are penumbras");
  for (const Error& error : { maps, openGL })
  {
    checks.expect(error.penumbra < bars.penumbra, name + ": penumbras");
    checks.expect(error.penumbra < bars.ofSharp * sharp.penumbra, name + ": nearer than sharp");
    checks.expect(error.all < 0.6 * sharp.all, name + ": all pixels");
  }
  // The CPU's maps hold what is looked up alone, those of OpenGL are whole.
  const Difference apart = difference(ways.maps, ways.openGL);
  std::cout << "  CPU and OpenGL: " << apart.mean << " levels, at most " << apart.largest << "\n";
  checks.expect(apart.mean < 0.02, name + ": the same by maps of the CPU and of OpenGL");
  return maps;
}

/// What of a disc of radius 1 lies beyond a line so far from its middle.
double segment(double c)
{
  c = std::clamp(c, -1.0, 1.0);
  return (std::acos(c) - c * std::sqrt(1.0 - c * c)) / Pi;
}

struct Edge
{
  const char* name;
  double at[3]; // the ball, or the way to the disc
  double size;
  bool ball;
  double turn; // of the half plane, radians
};

/// A light over a half plane at height 1 whose edge goes through the z axis, seen from above
/// without it. 32 samples of a spiral turned at random are off by 0.022 (RMS) of a disc that a
/// straight edge cuts; the rest is what the search misses at the rim of penumbras, and the texels.
void expectEdge(const Edge& c, Checks& checks)
{
  constexpr double Half = 1.2; // of what is seen
  constexpr int Pixels = 200;
  const double back = c.ball ? 1.0 / (c.at[2] - 1.0) : 1.0 / c.at[2];
  const double middle[] = { -c.at[0] * back, -c.at[1] * back };
  const auto fill = [&](Stage& stage)
  {
    stage.addGround(5.0);
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(0.0, -6.0, 1.0);
    plane->SetPoint1(6.0, -6.0, 1.0);
    plane->SetPoint2(0.0, 6.0, 1.0);
    stage.add(plane, 0.8, 0.8, 0.8)->RotateZ(c.turn * 180.0 / Pi);
    c.ball ? stage.addBulb(c.at[0], c.at[1], c.at[2]) : stage.addSun(c.at[0], c.at[1], c.at[2]);
    vtkCamera* camera = stage.renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetParallelScale(Half);
    camera->SetPosition(middle[0], middle[1], 50.0);
    camera->SetFocalPoint(middle[0], middle[1], 0.0);
    camera->SetViewUp(0.0, 1.0, 0.0);
    camera->SetClippingRange(49.5, 51.0); // nothing of what casts
  };
  const Ways ways = draw(fill, c.size, Pixels);
  Shares truth;
  for (int i = 0; i < Pixels * Pixels; ++i)
  {
    const double p[] = { middle[0] + Half * (2.0 * (i % Pixels + 0.5) / Pixels - 1.0),
      middle[1] + Half * (2.0 * (i / Pixels + 0.5) / Pixels - 1.0) };
    const double to[] = { c.at[0] - c.ball * p[0], c.at[1] - c.ball * p[1], c.at[2] };
    const double length = std::hypot(to[0], to[1], to[2]);
    // The sine of the way to the light with the plane through the point and the edge.
    const double beyond[] = { std::cos(c.turn), std::sin(c.turn) };
    const double along = p[0] * beyond[0] + p[1] * beyond[1];
    const double sine =
      (to[0] * beyond[0] + to[1] * beyond[1] + to[2] * along) / (length * std::hypot(1.0, along));
    const double share = c.size / length;
    const double rim =
      c.ball ? share / std::sqrt(1.0 - share * share) : std::tan(c.size * Pi / 360.0);
    truth.push_back(segment(sine / std::sqrt(1.0 - sine * sine) / rim));
  }
  judge(c.name, ways, truth, Mask(truth.size(), 1), { 0.045, 0.3 }, checks);
}

void addBoxes(Stage& stage, double ground = 3.0)
{
  stage.addGround(ground);
  stage.add(box(1.0, -0.7, 0.0, 0.5), 0.9, 0.5, 0.3);
  stage.add(box(0.25, 0.6, -0.8, 0.125), 0.5, 0.8, 0.4);
  stage.add(spike(0.9, 1.2, 0.6, 0.45), 0.8, 0.8, 0.3);
}

void addBall(Stage& stage)
{
  stage.addGround();
  stage.add(ball(0.6, 0.0, 0.0, 0.6), 0.9, 0.5, 0.3);
}

void addFloating(Stage& stage)
{
  stage.addGround();
  stage.add(ball(0.4, -1.1, -0.5, 0.6), 0.9, 0.5, 0.3);
  stage.add(box(0.5, 1.0, -0.8, 0.6), 0.5, 0.8, 0.4);
  stage.add(spike(0.9, 0.2, 1.2, 0.5), 0.8, 0.8, 0.3);
  stage.add(ring(0.5, 0.0, 0.0, 1.5), 0.8, 0.8, 0.3);
}

/// Against 256 rays of the CPU from each point of the same surfaces.
void expectRays(
  const char* name, const Fill& fill, double size, const Bars& bars, bool leaks, Checks& checks)
{
  constexpr int Edge = 300;
  const Ways ways = draw(fill, size, Edge);
  const Mask mask = awayFromEdges(ways.unshadowed, 2);
  const Shares truth = sharesOf(ways.rays, ways.unshadowed, mask);
  judge(name, ways, truth, mask, bars, checks);
  const std::size_t wrong =
    wrongFarFromPenumbras(truth, sharesOf(ways.maps, ways.unshadowed, mask), Edge, 6);
  std::cout << "  " << wrong << " pixels wrong far from penumbras\n";
  checks.expect(leaks || wrong == 0, std::string(name) + ": neither acne nor leaks");
}

void compareScenes(Checks& checks)
{
  const auto with = [](auto fill, auto light)
  {
    return [=](Stage& stage)
    {
      fill(stage);
      light(stage);
    };
  };
  const auto boxes = [](Stage& stage) { addBoxes(stage); };
  const auto bulb = [](double x, double y, double z)
  { return [=](Stage& stage) { stage.addBulb(x, y, z); }; };
  const auto sun = [](double x, double y, double z)
  { return [=](Stage& stage) { stage.addSun(x, y, z); }; };
  // Flat faces and straight edges are nearly those of closed forms.
  const Bars plain{ 0.045, 0.4 };
  // What hides light at many depths has one mean depth: half of the error of round things.
  const Bars round{ 0.08, 0.4 };
  expectRays("boxes", with(boxes, bulb(3.0, -2.5, 4.0)), 0.5, plain, false, checks);
  expectRays("disc of 8 degrees", with(boxes, sun(2.0, -1.5, 3.0)), 8.0, plain, false, checks);
  expectRays("sun", with(boxes, sun(2.0, -1.5, 3.0)), 0.533, plain, false, checks);
  // Its box tells nothing of how near casters are: the search is far wider than what there is.
  expectRays(
    "on a vast ground that casts",
    [&](Stage& stage)
    {
      addBoxes(stage, 200.0);
      stage.add(box(8.0, 0.0, 60.0, 0.0), 0.9, 0.5, 0.3); // half of it below the ground
      stage.addSun(2.0, -1.5, 3.0);
    },
    12.0, { 0.13, 0.6 }, false, checks);
  expectRays("low disc", with(boxes, sun(3.0, -1.5, 1.0)), 5.0, plain, false, checks);
  expectRays("spot",
    with(boxes, [](Stage& stage) { stage.addBulb(1.5, -2.0, 4.0)->SetConeAngle(25.0); }), 0.4,
    plain, false, checks);
  expectRays("ball", with(addBall, bulb(2.0, -1.5, 4.0)), 0.5, round, false, checks);
  expectRays("floating", with(addFloating, bulb(1.0, -1.5, 4.0)), 0.4, round, false, checks);
  expectRays("six maps", with(addFloating, bulb(0.1, -0.2, 0.65)), 0.2, round, true, checks);
  expectRays("translucent",
    with(addBall,
      [](Stage& stage)
      {
        stage.add(box(0.6, 1.0, -0.3, 0.8), 0.3, 0.5, 0.9)->GetProperty()->SetOpacity(0.5);
        stage.addBulb(2.0, -1.5, 4.0);
      }),
    0.5, round, false, checks);
  // A map does not know what lies behind the first caster.
  expectRays("one above the other",
    with(boxes,
      [](Stage& stage)
      {
        stage.add(box(1.0, -0.4, -0.2, 2.6), 0.9, 0.5, 0.3);
        stage.addBulb(1.0, -1.0, 5.0);
      }),
    0.5, { 0.13, 0.5 }, true, checks);
}

/// A light without a size stays what it is: after another size, and beside lights that have one.
void expectSharp(Checks& checks)
{
  Stage stage;
  addBoxes(stage);
  stage.pass->SetShadowTechniqueToShadowBuffer();
  stage.pass->SetBackendToOpenGL();
  vtkLight* sun = stage.addSun(2.0, -1.5, 3.0);
  const Picture sharp = capture(stage.window);
  vtkSVORenderPass::SetLightSize(8.0, sun);
  const Picture soft = capture(stage.window);
  vtkSVORenderPass::SetLightSize(0.0, sun);
  checks.expect(capture(stage.window).rgb == sharp.rgb, "no size: the picture of before");
  checks.expect(difference(sharp, soft).largest > 50, "a size is seen");
  vtkLight* black = stage.addBulb(1.0, 1.0, 3.0);
  black->SetIntensity(0.0);
  vtkSVORenderPass::SetLightSize(0.5, black);
  checks.expect(
    difference(capture(stage.window), sharp).largest <= 1, "sharp beside a light with a size");
}
}

int TestSVOSoftReceivers(int, char*[])
{
  Checks checks;
  for (const Edge& edge : { Edge{ "disc of 2 degrees", { 0.0, 0.0, 1.0 }, 2.0, false, 0.4 },
         Edge{ "disc of 10 degrees", { 0.0, 0.0, 1.0 }, 10.0, false, 0.4 },
         Edge{ "disc of 25 degrees aside", { 0.3, -0.8, 1.5 }, 25.0, false, 0.0 },
         Edge{ "ball of 0.1", { 0.0, 0.0, 3.0 }, 0.1, true, 0.3 },
         Edge{ "ball of 0.4", { 0.5, 0.3, 4.0 }, 0.4, true, 0.78 },
         Edge{ "ball of 1", { 0.5, 0.3, 4.0 }, 1.0, true, 1.0 } })
  {
    expectEdge(edge, checks);
  }
  compareScenes(checks);
  expectSharp(checks);
  return checks.exitCode();
}
