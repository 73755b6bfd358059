// Lights with a size on surfaces that VTK draws, by shadow maps of the CPU and of OpenGL: against
// closed forms of penumbras, and against rays of the CPU.
#include "svoTestStage.h"

#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkLightCollection.h"
#include "vtkPlaneSource.h"
#include "vtkProperty.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using namespace svotest;

const double Pi = std::acos(-1.0);

/// Of each pixel the share of light that is left; negative where that is not known.
using Shares = std::vector<double>;

struct Error
{
  double penumbra = 0.0, all = 0.0, most = 0.0; // RMS in penumbras and over all pixels; largest
  double penumbras = 0.0;                       // the part of the pixels that lie in one
  std::size_t pixels = 0;

  Error(const Shares& truth, const Shares& found)
  {
    std::size_t between = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
    {
      if (truth[i] < 0.0 || found[i] < 0.0)
      {
        continue;
      }
      const double off = found[i] - truth[i];
      ++this->pixels;
      this->all += off * off;
      this->most = std::max(this->most, std::abs(off));
      if (truth[i] > 0.02 && truth[i] < 0.98)
      {
        ++between;
        this->penumbra += off * off;
      }
    }
    this->penumbra = std::sqrt(this->penumbra / std::max<double>(between, 1.0));
    this->all = std::sqrt(this->all / std::max<double>(this->pixels, 1.0));
    this->penumbras = between / std::max<double>(this->pixels, 1.0);
  }
};

void save(const Picture& picture, const std::string& name)
{
  if (const char* folder = std::getenv("SOFT_PICTURES"))
  {
    std::ofstream file(folder + ("/" + name + ".ppm"), std::ios::binary);
    file << "P6 " << picture.width << ' ' << picture.height << " 255\n";
    for (int y = picture.height - 1; y >= 0; --y)
    {
      file.write(reinterpret_cast<const char*>(&picture.rgb[3ull * y * picture.width]),
        3ll * picture.width);
    }
  }
}

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

struct Ways
{
  Picture unshadowed, rays, sharp, maps, openGL;
};

/// The same scene by rays of the CPU, and drawn by VTK.
Ways draw(const std::string& name, const std::function<void(Stage&)>& fill, double size, int edge)
{
  Ways ways;
  Stage stage(edge, edge);
  stage.pass->SetBackendToCPU();
  stage.pass->SetShadowTechniqueToShadowBuffer();
  stage.pass->SetMaximumLightSamples(256);
  stage.pass->SetFilterShadows(true);
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
  ways.maps = capture(stage.window);
  vtkSVORenderPass::SetLightSize(0.0, light);
  ways.sharp = capture(stage.window);
  vtkSVORenderPass::SetLightSize(size, light);
  stage.pass->SetBackendToOpenGL();
  ways.openGL = capture(stage.window);
  save(ways.rays, name + "-rays");
  save(ways.maps, name + "-maps");
  save(ways.openGL, name + "-opengl");
  return ways;
}

void tell(const std::string& name, const Error& error)
{
  std::cout << name << ": RMS " << error.penumbra << " in penumbras (" << 100.0 * error.penumbras
            << " %), " << error.all << " of " << error.pixels << " pixels, at most " << error.most
            << "\n";
}

/// What of a disc of radius 1 lies beyond a line so far from its middle.
double segment(double c)
{
  c = std::clamp(c, -1.0, 1.0);
  return (std::acos(c) - c * std::sqrt(1.0 - c * c)) / Pi;
}

void closedForm(Checks& checks)
{
  struct Case
  {
    const char* name;
    double at[3];
    double size;
    bool ball;
    double turn;
  };
  for (const Case& c :
    { Case{ "disc of 2 degrees above", { 0.0, 0.0, 1.0 }, 2.0, false, 0.4 },
      Case{ "disc of 10 degrees above", { 0.0, 0.0, 1.0 }, 10.0, false, 0.4 },
      Case{ "disc of 25 degrees aside", { 0.3, -0.8, 1.5 }, 25.0, false, 0.0 },
      Case{ "ball of 0.1", { 0.0, 0.0, 3.0 }, 0.1, true, 0.3 },
      Case{ "ball of 0.4", { 0.5, 0.3, 4.0 }, 0.4, true, 0.78 },
      Case{ "ball of 1", { 0.5, 0.3, 4.0 }, 1.0, true, 1.0 } })
  {
    const double half = 1.2;
    const double beyond[] = { std::cos(c.turn), std::sin(c.turn) };
    const double back = c.ball ? 1.0 / (c.at[2] - 1.0) : 1.0 / c.at[2];
    const double middle[] = { -c.at[0] * back, -c.at[1] * back };
    const auto fill = [&](Stage& stage)
    {
      stage.addGround(5.0);
      vtkNew<vtkPlaneSource> plane; // beyond a line through the z axis
      plane->SetOrigin(0.0, -6.0, 1.0);
      plane->SetPoint1(6.0, -6.0, 1.0);
      plane->SetPoint2(0.0, 6.0, 1.0);
      stage.add(plane, 0.8, 0.8, 0.8)->RotateZ(c.turn * 180.0 / Pi);
      c.ball ? stage.addBulb(c.at[0], c.at[1], c.at[2]) : stage.addSun(c.at[0], c.at[1], c.at[2]);
      vtkCamera* camera = stage.renderer->GetActiveCamera();
      camera->ParallelProjectionOn();
      camera->SetParallelScale(half);
      camera->SetPosition(middle[0], middle[1], 50.0);
      camera->SetFocalPoint(middle[0], middle[1], 0.0);
      camera->SetViewUp(0.0, 1.0, 0.0);
      camera->SetClippingRange(49.5, 51.0); // nothing of what casts is seen
      stage.pass->SetShadowBufferResolution(2048);
    };
    const int edge = 200;
    const Ways ways = draw(c.name, fill, c.size, edge);
    Shares truth;
    for (int y = 0; y < edge; ++y)
    {
      for (int x = 0; x < edge; ++x)
      {
        const double p[] = { middle[0] + half * (2.0 * (x + 0.5) / edge - 1.0),
          middle[1] + half * (2.0 * (y + 0.5) / edge - 1.0) };
        double to[] = { c.at[0], c.at[1], c.at[2] };
        to[0] -= c.ball ? p[0] : 0.0;
        to[1] -= c.ball ? p[1] : 0.0;
        const double length = std::hypot(std::hypot(to[0], to[1]), to[2]);
        // The plane through the point and the edge: its normal with the way to the light.
        const double along = p[0] * beyond[0] + p[1] * beyond[1];
        const double sine = (to[0] * beyond[0] + to[1] * beyond[1] + to[2] * along) /
          (length * std::hypot(1.0, along));
        const double tangent = sine / std::sqrt(1.0 - sine * sine);
        const double share = c.size / length;
        const double rim = c.ball ? share / std::sqrt(1.0 - share * share)
                                  : std::tan(0.5 * c.size * Pi / 180.0);
        truth.push_back(segment(tangent / rim));
      }
    }
    const Mask mask(truth.size(), 1);
    const auto error = [&](const Picture& p)
    { return Error(truth, sharesOf(p, ways.unshadowed, mask)); };
    tell(std::string(c.name) + ", rays", error(ways.rays));
    tell(std::string(c.name) + ", sharp", error(ways.sharp));
    tell(std::string(c.name) + ", maps", error(ways.maps));
    tell(std::string(c.name) + ", OpenGL", error(ways.openGL));
    (void)checks;
  }
}

void scenes(Checks& checks)
{
  struct Case
  {
    const char* name;
    std::function<void(Stage&)> fill;
    double size;
  };
  const auto ballOnGround = [](Stage& s) {
    s.addGround();
    s.add(ball(0.6, 0.0, 0.0, 0.6), 0.9, 0.5, 0.3);
  };
  const auto boxes = [](Stage& s) {
    s.addGround();
    s.add(box(1.0, -0.7, 0.0, 0.5), 0.9, 0.5, 0.3);
    s.add(box(0.25, 0.6, -0.8, 0.125), 0.5, 0.8, 0.4);
    s.add(spike(0.9, 1.2, 0.6, 0.45), 0.8, 0.8, 0.3);
  };
  const auto many = [](Stage& s) {
    s.addGround();
    s.add(ball(0.4, -1.1, -0.5, 0.6), 0.9, 0.5, 0.3);
    s.add(box(0.5, 1.0, -0.8, 0.6), 0.5, 0.8, 0.4);
    s.add(spike(0.9, 0.2, 1.2, 0.5), 0.8, 0.8, 0.3);
    s.add(ring(0.5, 0.0, 0.0, 1.5), 0.8, 0.8, 0.3);
  };
  for (const Case& c : std::vector<Case>{
         { "sphere", [&](Stage& s) { ballOnGround(s); s.addBulb(2.0, -1.5, 4.0); }, 0.5 },
         { "box", [&](Stage& s) { boxes(s); s.addBulb(3.0, -2.5, 4.0); }, 0.5 },
         { "disc", [&](Stage& s) { boxes(s); s.addSun(2.0, -1.5, 3.0); }, 8.0 },
         { "sun", [&](Stage& s) { boxes(s); s.addSun(2.0, -1.5, 3.0); }, 0.533 },
         { "low disc", [&](Stage& s) { boxes(s); s.addSun(3.0, -1.5, 1.0); }, 5.0 },
         { "many", [&](Stage& s) { many(s); s.addBulb(1.0, -1.5, 4.0); }, 0.4 },
         { "midst", [&](Stage& s) { many(s); s.addBulb(0.1, -0.2, 0.65); }, 0.2 },
         { "layers",
           [&](Stage& s) {
             boxes(s);
             s.add(box(1.0, -0.4, -0.2, 2.6), 0.9, 0.5, 0.3);
             s.addBulb(1.0, -1.0, 5.0);
           },
           0.5 },
         { "spot",
           [&](Stage& s) { boxes(s); s.addBulb(1.5, -2.0, 4.0)->SetConeAngle(25.0); }, 0.4 },
         { "translucent",
           [&](Stage& s) {
             ballOnGround(s);
             s.add(box(0.6, 1.0, -0.3, 0.8), 0.3, 0.5, 0.9)->GetProperty()->SetOpacity(0.5);
             s.addBulb(2.0, -1.5, 4.0);
           },
           0.5 } })
  {
    const Ways ways = draw(c.name, c.fill, c.size, 300);
    const Mask mask = awayFromEdges(ways.unshadowed, 2);
    const Shares truth = sharesOf(ways.rays, ways.unshadowed, mask);
    const auto error = [&](const Picture& p)
    { return Error(truth, sharesOf(p, ways.unshadowed, mask)); };
    tell(std::string(c.name) + ", sharp", error(ways.sharp));
    tell(std::string(c.name) + ", maps", error(ways.maps));
    tell(std::string(c.name) + ", OpenGL", error(ways.openGL));
    (void)checks;
  }
}
}

int TestSVOSoftReceivers(int, char*[])
{
  Checks checks;
  closedForm(checks);
  scenes(checks);
  return checks.exitCode();
}
