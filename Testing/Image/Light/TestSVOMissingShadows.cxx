// Where no shadow can be seen one message says why, once for each cause; where somebody asked for
// none there is silence.
#include "svoTestStage.h"

#include "../../Unit/svoTestMessages.h"

#include "vtkPlane.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkVolume.h"

#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using namespace svotest;
using Pass = vtkSVORenderPass;

/// A ball and a box, neither of them on a ground.
struct Scene : Stage
{
  Scene()
    : Stage(60, 60)
    , objects{ this->add(ball(0.6, -0.8, 0.0, 1.0), 0.9, 0.5, 0.3),
      this->add(box(0.7, 0.8, 0.5, 0.7), 0.3, 0.6, 0.9) }
    , sun(this->addSun(2.0, -1.5, 4.0))
    , messages(this->pass)
  {
  }
  /// What is said in two frames.
  std::string said()
  {
    const std::size_t before = this->messages.warnings.size();
    capture(this->window);
    const std::size_t first = this->messages.warnings.size() - before;
    capture(this->window);
    const std::size_t second = this->messages.warnings.size() - before - first;
    return second > 0 || first > 1 ? "too much" : first == 0 ? "" : this->messages.warnings.back();
  }
  const std::vector<vtkActor*> objects;
  vtkLight* sun;
  const svo::TestMessages messages;
};

struct Case
{
  std::string name;
  std::function<void(Scene&)> prepare;
  std::string expected; // in the message; empty: there is none
};

std::vector<Case> cases()
{
  const auto each = [](const std::function<void(vtkActor*)>& change)
  {
    return [change](Scene& s)
    {
      for (vtkActor* object : s.objects)
      {
        change(object);
      }
    };
  };
  const auto wires = [](vtkActor* a) { a->GetProperty()->SetRepresentationToWireframe(); };
  const auto unlit = [](vtkActor* a) { a->GetProperty()->LightingOff(); };
  const auto clip = [](vtkActor* a)
  {
    vtkNew<vtkPlane> plane;
    a->GetMapper()->AddClippingPlane(plane);
  };
  return {
    { "shadows", [](Scene&) {}, "" },
    { "wires", each(wires), "Each of 2 objects is shown as wireframe or points." },
    { "wires beside a surface", [=](Scene& s) { wires(s.objects[0]); }, "" },
    { "wires, clipped",
      [=](Scene& s)
      {
        wires(s.objects[0]);
        clip(s.objects[1]);
      },
      "Each of 2 objects has clipping planes on its mapper, or is shown as wireframe or points." },
    { "one alone",
      [=](Scene& s)
      {
        clip(s.objects[0]);
        s.objects[1]->VisibilityOff();
      },
      "The only object has clipping planes" },
    { "clipped beside a surface", [=](Scene& s) { clip(s.objects[0]); },
      "because its mapper has clipping planes" },
    { "clipped, to cast all the same",
      [=](Scene& s)
      {
        clip(s.objects[0]);
        Pass::SetCastShadow(true, s.objects[0]);
      },
      "" },
    { "clipped, to cast none",
      [=](Scene& s)
      {
        clip(s.objects[0]);
        Pass::SetCastShadow(false, s.objects[0]);
      },
      "" },
    { "a volume",
      [=](Scene& s)
      {
        s.renderer->RemoveAllViewProps();
        s.renderer->AddViewProp(vtkNew<vtkVolume>());
      },
      "The only object is neither an actor" },
    { "unlit", each(unlit), "Each of 2 objects looks the same in every light" },
    { "unlit beside the lit", [=](Scene& s) { unlit(s.objects[0]); }, "" },
    { "translucent, without their shadows",
      [=](Scene& s)
      {
        s.objects[0]->GetProperty()->SetOpacity(0.5);
        s.objects[1]->GetProperty()->SetOpacity(0.5);
        s.pass->TranslucentShadowsOff();
      },
      "its opacity makes it translucent" },
    { "without octrees", [](Scene& s) { s.pass->ConvertPolyDataOff(); },
      "Each of 2 objects comes without an octree." },
    { "a light without direction",
      [](Scene& s)
      {
        s.sun->SetPosition(1, 2, 3);
        s.sun->SetFocalPoint(1, 2, 3);
      },
      "A light has no direction" },
    { "a light at no number", [](Scene& s) { s.sun->SetPosition(std::nan(""), 2, 3); },
      "A light has no direction" },
    { "a headlight", [](Scene& s) { s.sun->SetLightTypeToHeadlight(); }, "headlight" },
    { "nothing there", [](Scene& s) { s.renderer->RemoveAllViewProps(); }, "" },
    { "nothing to be seen",
      each([](vtkActor* a)
        { static_cast<vtkPolyDataMapper*>(a->GetMapper())->SetInputData(vtkNew<vtkPolyData>()); }),
      "" },
    // Asked for:
    { "no technique",
      [=](Scene& s)
      {
        each(wires)(s);
        s.pass->SetShadowTechniqueToNone();
      },
      "" },
    { "no intensity",
      [=](Scene& s)
      {
        each(wires)(s);
        s.pass->SetShadowIntensity(0.0);
      },
      "" },
    { "told to cast none", each([](vtkActor* a) { Pass::SetCastShadow(false, a); }), "" },
    { "told to receive none", each([](vtkActor* a) { Pass::SetReceiveShadow(false, a); }), "" },
    { "a light that was told to cast none",
      [=](Scene& s)
      {
        each(wires)(s);
        Pass::SetCastShadow(false, s.sun);
      },
      "" },
    // Of a host:
    { "attached, nothing chosen",
      [=](Scene& s)
      {
        s.usePass(false);
        s.pass->Attach(s.renderer);
      },
      "" },
    { "attached, unlit beside lines of the host's",
      [=](Scene& s)
      {
        s.usePass(false);
        s.pass->Attach(s.renderer);
        s.pass->ShadowsForEverythingOn();
        each(unlit)(s);
        wires(s.objects[1]);
      },
      "The only object looks the same in every light" },
    { "attached, clipped",
      [=](Scene& s)
      {
        s.usePass(false);
        s.pass->Attach(s.renderer);
        s.pass->ShadowsForEverythingOn();
        wires(s.objects[0]); // who chooses that knows
        clip(s.objects[1]);
      },
      "The only object has clipping planes" },
  };
}
}

int TestSVOMissingShadows(int, char*[])
{
  Checks checks;
  for (const Case& one : cases())
  {
    Scene scene;
    one.prepare(scene);
    const std::string said = scene.said();
    std::cout << one.name << ": " << said << "\n";
    checks.expect(
      one.expected.empty() ? said.empty() : said.find(one.expected) != std::string::npos,
      one.name + ": expected \"" + one.expected + "\"");
  }

  Scene aimless;
  aimless.sun->SetFocalPoint(aimless.sun->GetPosition());
  aimless.said();
  checks.expect(!Pass::GetCastShadow(aimless.sun), "a light without direction casts none");
  checks.expect(
    std::string(aimless.pass->GetCastingLights()).find("has no direction") != std::string::npos,
    "and the list of lights says why");

  aimless.sun->SetLightTypeToCameraLight();
  checks.expect(!Pass::GetCastShadow(aimless.sun), "nor does one that is the camera's");

  // Another cause is another message; more of the same is none.
  Scene scene;
  scene.objects[0]->GetProperty()->SetRepresentationToWireframe();
  scene.objects[1]->VisibilityOff();
  checks.expect(!scene.said().empty(), "one cause");
  scene.objects[1]->VisibilityOn();
  scene.objects[1]->GetProperty()->SetRepresentationToWireframe();
  checks.expect(scene.said().empty(), "and another object");
  for (vtkActor* object : scene.objects)
  {
    object->GetProperty()->SetRepresentationToSurface();
    object->GetProperty()->LightingOff();
  }
  checks.expect(scene.said().find("looks the same") != std::string::npos, "another cause");
  return checks.exitCode();
}
