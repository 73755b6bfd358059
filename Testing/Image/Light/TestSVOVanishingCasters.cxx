// Shadow maps are kept for rasterised surfaces from frame to frame, and are others as soon as a
// caster goes, comes or moves, a light moves, or somebody starts to receive: the picture has no
// history.
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkLightCollection.h"
#include "vtkProperty.h"

#include <functional>
#include <iostream>
#include <string>

namespace
{
using namespace svotest;

struct Scene
{
  Scene()
  {
    this->ground = this->stage.addGround();
    this->ground->GetProperty()->EdgeVisibilityOn(); // rasterised
    // What the light's map is fitted to.
    this->stage.add(box(0.5, -1.8, -1.8, 0.3), 0.4, 0.7, 0.9);
    this->stage.add(box(0.5, 1.8, 1.8, 1.0), 0.4, 0.7, 0.9);
    this->middle = this->stage.add(ball(0.5, 0.0, 0.0, 0.7), 0.9, 0.5, 0.3);
    this->sun = this->stage.addSun(1.0, -1.5, 4.0);
  }
  Stage stage;
  vtkActor* ground;
  vtkActor* middle;
  vtkLight* sun;
};

void compare(Checks& checks, Scene& old, const std::function<void(Scene&)>& set, const char* name)
{
  Scene fresh;
  set(old);
  set(fresh);
  const Difference d = difference(capture(old.stage.window), capture(fresh.stage.window));
  std::cout << name << ": mean difference from a fresh picture " << d.mean << ", largest "
            << d.largest << '\n';
  checks.expect(d.largest == 0, std::string(name) + ": the picture has no history");
}
}

int TestSVOVanishingCasters(int, char*[])
{
  Checks checks;
  for (const bool bulb : { false, true })
  {
    Scene scene;
    const Picture before = capture(scene.stage.window);
    const auto light = [bulb](Scene& s)
    {
      if (bulb && s.stage.renderer->GetLights()->GetNumberOfItems() == 1)
      {
        s.stage.addBulb(0.3, 0.2, 3.0);
      }
    };
    compare(
      checks, scene, [&](Scene& s) { light(s); }, "as it was");
    compare(
      checks, scene,
      [&](Scene& s)
      {
        light(s);
        s.middle->VisibilityOff();
      },
      "a caster goes");
    checks.expect(
      difference(before, capture(scene.stage.window)).mean > 0.5, "and its shadow with it");
    compare(
      checks, scene,
      [&](Scene& s)
      {
        light(s);
        s.middle->VisibilityOn();
      },
      "it comes back");
    compare(
      checks, scene,
      [&](Scene& s)
      {
        light(s);
        s.middle->SetPosition(0.3, 0.2, 0.0);
      },
      "it moves");
    for (int i = 0; i < 2; ++i)
    {
      compare(
        checks, scene,
        [&](Scene& s)
        {
          light(s);
          s.middle->SetPosition(0.3, 0.2, 0.0);
          s.stage.renderer->GetActiveCamera()->Azimuth(&s == &scene ? 5.0 : 5.0 * (i + 1));
        },
        "the camera moves");
    }
    const auto none = [&](Scene& s)
    {
      light(s);
      s.stage.renderer->GetActiveCamera()->Azimuth(&s == &scene ? 0.0 : 10.0);
      s.middle->SetPosition(0.3, 0.2, 0.0);
    };
    compare(
      checks, scene,
      [&](Scene& s)
      {
        none(s);
        s.sun->SetPosition(2.0, -1.0, 4.0);
      },
      "a light moves");
    compare(
      checks, scene,
      [&](Scene& s)
      {
        none(s);
        s.sun->SetPosition(1.0, -1.5, 4.0);
      },
      "it moves back");
    compare(
      checks, scene,
      [&](Scene& s)
      {
        none(s);
        s.ground->GetProperty()->EdgeVisibilityOff();
      },
      "nothing that is rasterised receives");
    compare(
      checks, scene,
      [&](Scene& s)
      {
        none(s);
        s.ground->GetProperty()->EdgeVisibilityOn();
      },
      "the ground receives again");
    scene.stage.pass->ReleaseOctrees();
    compare(checks, scene, none, "octrees are released");
    scene.stage.pass->SetFrameCoherence(false);
    compare(checks, scene, none, "nothing is kept");
    for (const double x : { 0.5, 0.3 })
    {
      compare(
        checks, scene,
        [&](Scene& s)
        {
          none(s);
          s.middle->SetPosition(x, 0.2, 0.0);
        },
        "a caster moves and nothing is kept");
    }
    scene.stage.pass->SetFrameCoherence(true);
    compare(checks, scene, none, "all is kept again");
  }
  return checks.exitCode();
}
