// Observers that act in the midst of a frame: they draw another window with the same pass, drop the
// pass, exchange what is drawn, finalize the window, detach the pass. Nothing of that may do harm,
// and each picture is the one that a new pass makes of the same scene.
#include "svoTestStage.h"

#include "vtkCommand.h"
#include "vtkCullerCollection.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderer.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProp.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkWeakPointer.h"

#include <functional>
#include <iostream>
#include <string>

using namespace svotest;

namespace
{
/// Calls a function at an event.
class Calling : public vtkCommand
{
public:
  static Calling* New() { return new Calling; }
  void Execute(vtkObject*, unsigned long, void*) override
  {
    if (this->body)
    {
      this->body();
    }
  }
  std::function<void()> body;
};

void at(vtkObject* object, unsigned long event, std::function<void()> body, float priority = 0.0f)
{
  vtkNew<Calling> command;
  command->body = std::move(body);
  object->AddObserver(event, command, priority);
}

/// The same, but for the first time only.
std::function<void()> once(std::function<void()> body)
{
  return [body = std::move(body), done = false]() mutable
  {
    if (!done)
    {
      done = true;
      body();
    }
  };
}

/// Draws nothing, and calls something when it is to be drawn.
class DrawnProp : public vtkProp
{
public:
  static DrawnProp* New();
  vtkTypeMacro(DrawnProp, vtkProp);
  int RenderOpaqueGeometry(vtkViewport*) override
  {
    if (this->whileDrawing)
    {
      this->whileDrawing();
    }
    return 0;
  }
  std::function<void()> whileDrawing;
};
vtkStandardNewMacro(DrawnProp);

/// All renderers of this class have the same address, one after the other.
class RendererOfOnePlace : public vtkOpenGLRenderer
{
public:
  static RendererOfOnePlace* New() { return new RendererOfOnePlace; }
  static void* operator new(std::size_t size)
  {
    alignas(16) static unsigned char place[sizeof(vtkOpenGLRenderer) + 256];
    return size <= sizeof(place) ? place : nullptr;
  }
  static void operator delete(void*) {}
};

/// A ball over a ground, in one window, with one pass that nobody else keeps.
struct Scene
{
  Scene()
  {
    this->stage.addSun(2.0, -1.5, 4.0);
    this->ball->SetThetaResolution(48);
    this->ball->SetPhiResolution(32);
    this->ball->SetRadius(0.7);
    this->ball->SetCenter(0.0, 0.0, 1.1);
    this->actor = this->stage.add(this->ball, 0.9, 0.5, 0.3);
    this->ground = this->stage.addGround();
    this->pass = vtkSmartPointer<vtkSVORenderPass>::New();
    this->pass->SetMaximumLevel(8);
    chooseBackend(this->pass);
    this->stage.renderer->SetPass(this->pass);
  }
  vtkMapper* mapper() { return this->actor->GetMapper(); }

  Stage stage;
  vtkNew<vtkSphereSource> ball;
  vtkActor* actor;
  vtkActor* ground;
  vtkSmartPointer<vtkSVORenderPass> pass;
};

/// What a pass that nothing happens to makes of a scene.
Picture expected(const std::function<void(Scene&)>& change = {})
{
  Scene scene;
  if (change)
  {
    change(scene);
  }
  return capture(scene.stage.window);
}

void expectSame(Checks& checks, const Picture& a, const Picture& b, const std::string& what)
{
  const int largest = a.size() == b.size() ? difference(a, b).largest : 255;
  std::cout << what << ": " << largest << " of 255\n";
  checks.expect(largest == 0, what);
}

void duringABuild(Checks& checks)
{
  const Picture still = expected();
  {
    Scene first;
    Scene second;
    Picture other;
    int calls = 0;
    second.stage.renderer->SetPass(first.pass);
    at(first.pass, vtkCommand::ProgressEvent,
      [&]
      {
        ++calls;
        if (other.size() == 0)
        {
          other = capture(second.stage.window);
        }
      });
    expectSame(checks, capture(first.stage.window), still, "another window is drawn meanwhile");
    expectSame(checks, other, still, "that other window");
    checks.expect(calls > 0, "there was progress");
    expectSame(checks, capture(first.stage.window), still, "the first window again");
    expectSame(checks, capture(second.stage.window), still, "the other window again");
    first.stage.renderer->SetPass(nullptr);
    second.stage.renderer->SetPass(nullptr);
  }
  {
    Scene scene;
    vtkWeakPointer<vtkSVORenderPass> watched(scene.pass);
    at(scene.pass, vtkCommand::ProgressEvent,
      once(
        [&]
        {
          scene.stage.usePass(false);
          scene.pass = nullptr;
        }));
    expectSame(checks, capture(scene.stage.window), still, "the pass is dropped");
    if (drawnByOpenGL())
    {
      capture(scene.stage.window); // mappers of receivers hold on to a pass until their next frame
    }
    checks.expect(!watched, "a dropped pass is gone after its last frame");
  }
  {
    const auto finer = [](Scene& scene) { scene.ball->SetThetaResolution(9); };
    Scene scene;
    at(scene.pass, vtkCommand::ProgressEvent,
      once(
        [&]
        {
          finer(scene);
          scene.ball->Update();
        }));
    expectSame(checks, capture(scene.stage.window), expected(finer), "the source is changed");
  }
  {
    Scene scene;
    at(scene.pass, vtkCommand::ProgressEvent,
      once([&] { scene.mapper()->SetInputConnection(0, nullptr); }));
    capture(scene.stage.window);
    expectSame(checks, capture(scene.stage.window),
      expected([](Scene& other) { other.mapper()->SetInputConnection(0, nullptr); }),
      "the source is taken away");
  }
  {
    const auto grow = [](Scene& scene)
    {
      vtkPolyData* mesh = scene.ball->GetOutput();
      for (int i = 0; i < 1000; ++i)
      {
        mesh->GetPoints()->InsertNextPoint(0.0, 0.0, 0.0);
      }
      mesh->GetPointData()->SetNormals(nullptr);
      mesh->GetPoints()->Modified();
    };
    Scene scene;
    at(scene.pass, vtkCommand::ProgressEvent, once([&] { grow(scene); }));
    expectSame(checks, capture(scene.stage.window),
      expected(
        [&](Scene& other)
        {
          other.ball->Update();
          grow(other);
        }),
      "the mesh is changed in place");
  }
  {
    Scene scene;
    at(scene.pass, vtkCommand::ProgressEvent,
      once([&] { scene.stage.renderer->RemoveActor(scene.actor); }));
    capture(scene.stage.window);
    expectSame(checks, capture(scene.stage.window),
      expected([](Scene& other) { other.stage.renderer->RemoveActor(other.actor); }),
      "an actor is removed");
  }
  {
    Scene scene;
    at(scene.pass, vtkCommand::ProgressEvent, once([&] { scene.stage.window->Finalize(); }));
    scene.stage.window->Render();
    expectSame(checks, capture(scene.stage.window), still, "the window was finalized");
  }
}

/// Pipelines run while a frame is collected, and have observers, too.
void inAPipeline(Checks& checks)
{
  const Picture still = expected();
  {
    Scene first;
    Scene second;
    first.stage.renderer->GetCullers()->RemoveAllItems(); // they ask for bounds before the pass
    second.stage.renderer->SetPass(first.pass);
    Picture other;
    at(first.ball, vtkCommand::StartEvent, once([&] { other = capture(second.stage.window); }));
    expectSame(checks, capture(first.stage.window), still, "a source has another window drawn");
    expectSame(checks, other, still, "the window that it has drawn");
    second.stage.renderer->SetPass(nullptr);
  }
  {
    Scene scene;
    scene.stage.renderer->GetCullers()->RemoveAllItems();
    at(scene.ball, vtkCommand::StartEvent,
      once(
        [&]
        {
          scene.stage.usePass(false);
          scene.pass = nullptr;
          scene.stage.renderer->RemoveActor(scene.ground);
        }));
    capture(scene.stage.window);
    checks.expect(!scene.stage.renderer->GetPass(), "a source drops the pass");
  }
  {
    Scene scene;
    scene.stage.renderer->GetCullers()->RemoveAllItems();
    at(scene.ball, vtkCommand::StartEvent, once([&] { scene.stage.window->Finalize(); }));
    scene.stage.window->Render();
    expectSame(checks, capture(scene.stage.window), still, "a source finalizes the window");
  }
}

/// The ball in a renderer that a pass is attached to.
struct HostScene
{
  HostScene()
  {
    this->scene.stage.usePass(false);
    this->actor->SetMapper(this->scene.mapper());
    this->actor->SetProperty(this->scene.actor->GetProperty());
    this->scene.stage.renderer->RemoveActor(this->scene.actor);
    this->scene.stage.renderer->AddActor(this->actor);
    this->scene.stage.renderer->AddViewProp(this->drawn);
    vtkSVORenderPass::SetUseSVO(true, this->actor);
  }
  vtkRenderer* renderer() { return this->scene.stage.renderer; }
  Picture picture() { return capture(this->scene.stage.window); }

  Scene scene;
  vtkNew<vtkActor> actor;
  vtkNew<DrawnProp> drawn;
};

enum class When
{
  FrameBegins,
  AfterThePassHasBegun,
  Collection,
  Drawing
};

void detached(Checks& checks, When when, bool drop, const std::string& name)
{
  Picture raster, traced;
  {
    HostScene plain;
    raster = plain.picture();
    plain.scene.pass->Attach(plain.renderer());
    traced = plain.picture();
    checks.expect(difference(raster, traced).largest > 0, "attached, the pass draws a shadow");
    plain.scene.pass->Detach(plain.renderer());
  } // or the passes would share their octrees, and nothing were built

  HostScene host;
  vtkSVORenderPass* pass = host.scene.pass;
  vtkWeakPointer<vtkSVORenderPass> watched(pass);
  const auto act = once(
    [&]
    {
      pass->Detach(host.renderer());
      if (drop)
      {
        host.scene.pass = nullptr;
      }
    });
  pass->Attach(host.renderer());
  switch (when)
  {
    case When::FrameBegins:
      at(host.renderer(), vtkCommand::StartEvent, act, 1.0f);
      break;
    case When::AfterThePassHasBegun:
      at(host.renderer(), vtkCommand::StartEvent, act, -2.0f);
      break;
    case When::Collection:
      at(pass, vtkCommand::ProgressEvent, act);
      break;
    case When::Drawing:
      host.drawn->whileDrawing = act;
      break;
  }
  const Picture during = host.picture();
  expectSame(checks, during, when == When::FrameBegins ? raster : traced, "detached " + name);
  expectSame(checks, host.picture(), raster, "the frame after that, " + name);
  checks.expect(!drop || !watched, "a dropped pass is gone, " + name);
  host.drawn->whileDrawing = {};
}

void attachments(Checks& checks)
{
  for (const bool drop : { false, true })
  {
    const std::string also = drop ? " and dropped" : "";
    detached(checks, When::FrameBegins, drop, "when the frame begins" + also);
    detached(checks, When::AfterThePassHasBegun, drop, "after the pass has begun" + also);
    detached(checks, When::Collection, drop, "during collection" + also);
    detached(checks, When::Drawing, drop, "while drawing" + also);
  }
  {
    HostScene host;
    host.scene.pass->Attach(host.renderer());
    const Picture traced = host.picture();
    at(host.renderer(), vtkCommand::StartEvent,
      once(
        [&]
        {
          host.scene.pass->Detach(host.renderer());
          host.scene.pass->Attach(host.renderer());
        }),
      -2.0f);
    expectSame(checks, host.picture(), traced, "detached and attached again in a frame");
    expectSame(checks, host.picture(), traced, "the frame after that");
    host.scene.pass->Detach(host.renderer());
  }
  // A renderer that comes into an old one's place is a new one.
  HostScene host;
  host.scene.pass->Attach(host.renderer());
  const Picture traced = host.picture();
  host.scene.pass->Detach(host.renderer());
  vtkRenderer* old = host.renderer();
  for (int round = 0; round < 2; ++round)
  {
    vtkSmartPointer<vtkRenderer> next =
      vtkSmartPointer<vtkRenderer>::Take(RendererOfOnePlace::New());
    next->SetActiveCamera(old->GetActiveCamera());
    next->SetBackground(old->GetBackground());
    next->AutomaticLightCreationOff();
    next->SetLightCollection(old->GetLights());
    next->AddActor(host.scene.ground);
    next->AddActor(host.actor);
    host.scene.stage.window->AddRenderer(next);
    host.scene.stage.window->RemoveRenderer(old);
    host.scene.pass->Attach(next);
    expectSame(checks, host.picture(), traced, "a renderer in the same place");
    host.scene.stage.window->AddRenderer(old);
    host.scene.stage.window->RemoveRenderer(next);
  }
}
}

int TestSVOReentrancy(int, char*[])
{
  Checks checks;
  duringABuild(checks);
  inAPipeline(checks);
  attachments(checks);
  return checks.exitCode();
}
