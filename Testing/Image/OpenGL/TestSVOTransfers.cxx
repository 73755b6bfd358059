// What crosses the bus in a frame with the OpenGL backend: nothing while nothing changes, where
// casters are if the camera or one of them has moved, and never a pixel back.
#include "svoOpenGL.h"
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkNew.h"
#include "vtkSphereSource.h"
#include "vtkTesting.h"

#include <algorithm>
#include <iostream>
#include <string>

#ifdef __GLEW_H__ // glad's functions are not to be exchanged

#include <dlfcn.h>

using namespace svotest;

namespace
{
struct Transfers
{
  long long sent = 0; // bytes
  int reads = 0;
} transfers;

/// A pixel counts as four bytes; there may be none.
void countPixels(long long pixels, const void* from)
{
  transfers.sent += from ? 4 * pixels : 0;
}

/// OpenGL's own of a function that this program has as well.
template <class Function>
Function* itself(Function*, const char* name)
{
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}
}

// What is linked by name, all libraries find here first.
void GLAPIENTRY glReadPixels(
  GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type, void* pixels)
{
  static const auto read = itself(&glReadPixels, "glReadPixels");
  ++transfers.reads;
  read(x, y, width, height, format, type, pixels);
}

void GLAPIENTRY glGetTexImage(GLenum target, GLint level, GLenum format, GLenum type, void* pixels)
{
  static const auto read = itself(&glGetTexImage, "glGetTexImage");
  ++transfers.reads;
  read(target, level, format, type, pixels);
}

void GLAPIENTRY glTexImage2D(GLenum target, GLint level, GLint kept, GLsizei width, GLsizei height,
  GLint border, GLenum format, GLenum type, const void* pixels)
{
  static const auto send = itself(&glTexImage2D, "glTexImage2D");
  countPixels(1LL * width * height, pixels);
  send(target, level, kept, width, height, border, format, type, pixels);
}

void GLAPIENTRY glTexSubImage2D(GLenum target, GLint level, GLint x, GLint y, GLsizei width,
  GLsizei height, GLenum format, GLenum type, const void* pixels)
{
  static const auto send = itself(&glTexSubImage2D, "glTexSubImage2D");
  countPixels(1LL * width * height, pixels);
  send(target, level, x, y, width, height, format, type, pixels);
}

namespace
{
/// Of three casters each takes 96 bytes, and 64 more of its shadow volume; a tree has five boxes of
/// 32.
constexpr long long MostOfMoving = 3 * (96 + 64) + 5 * 32;

/// Counts what GLEW has looked up, which it does for each window.
void countOthers()
{
  static const auto data = __glewBufferData;
  __glewBufferData = [](GLenum target, GLsizeiptr bytes, const void* from, GLenum usage)
  {
    transfers.sent += from ? bytes : 0;
    data(target, bytes, from, usage);
  };
  static const auto part = __glewBufferSubData;
  __glewBufferSubData = [](GLenum target, GLintptr first, GLsizeiptr bytes, const void* from)
  {
    transfers.sent += bytes;
    part(target, first, bytes, from);
  };
  static const auto layers = __glewTexSubImage3D;
  __glewTexSubImage3D = [](GLenum target, GLint level, GLint x, GLint y, GLint z, GLsizei width,
                          GLsizei height, GLsizei depth, GLenum format, GLenum type,
                          const void* from)
  {
    countPixels(1LL * width * height * depth, from);
    layers(target, level, x, y, z, width, height, depth, format, type, from);
  };
}

Transfers drawn(Stage& stage)
{
  transfers = {};
  stage.window->Render();
  return transfers;
}

void count(const std::string& name, void (*choose)(vtkSVORenderPass*), Checks& checks)
{
  Stage stage;
  stage.addGround();
  vtkActor* moved = stage.add(box(0.6, -1.1, 0.4, 0.5), 0.2, 0.6, 0.3);
  vtkNew<vtkSphereSource> ball;
  ball->SetCenter(0.6, 0.0, 0.8);
  stage.add(ball, 0.9, 0.5, 0.2);
  stage.addSun(3.0, -2.0, 4.0);
  stage.pass->SetBackendToOpenGL();
  choose(stage.pass);
  stage.window->Render();
  stage.window->Render(); // in the first frame actors are modified, and collected again in this one
  countOthers();
  const auto expect = [&](const std::string& what, long long most)
  {
    const Transfers found = drawn(stage);
    std::cout << name << ", " << what << ": " << found.sent << " bytes\n";
    checks.expect(found.sent <= most, name + ", " + what + ": little is sent");
    checks.expect(found.reads == 0, name + ", " + what + ": nothing is read back");
  };
  expect("nothing changes", 0);
  for (int i = 0; i < 2; ++i)
  {
    stage.renderer->GetActiveCamera()->Azimuth(1.0);
    expect("the camera moves", MostOfMoving);
    moved->AddPosition(0.01, 0.0, 0.0);
    expect("an actor moves", MostOfMoving);
  }
  expect("nothing changes", 0);
  // It is counted:
  ball->SetRadius(0.4);
  checks.expect(drawn(stage).sent > 10 * MostOfMoving, name + ": another mesh is sent");
  transfers = {};
  capture(stage.window);
  checks.expect(transfers.reads > 0, name + ": a picture is read");
}

/// Two renderers that show one mesh, and each another.
void share(Checks& checks)
{
  Stage left(240, 120);
  left.renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  Stage right(left, 0.5, 0.0, 1.0, 1.0);
  right.renderer->AddActor(left.add(ball(0.6, 0.4, 0.0, 1.2), 0.9, 0.5, 0.2));
  left.add(ring(0.5, -0.8, 0.0, 0.8), 0.3, 0.5, 0.9);
  vtkNew<vtkSphereSource> other;
  other->SetCenter(-0.8, 0.0, 0.8);
  other->SetThetaResolution(32);
  other->SetPhiResolution(32);
  for (Stage* stage : { &left, &right })
  {
    stage->addGround();
    stage->addSun(3.0, -2.0, 4.0);
    stage->pass->SetBackendToOpenGL();
    stage->pass->SetShadowTechniqueToShadowRays();
    stage->pass->SetMaximumLevel(7);
    stage->pass->SetOctreeMemoryLimit(2000);
  }
  right.renderer->DrawOff();
  left.window->Render();
  countOthers();
  const vtkIdType alone = left.pass->GetGPUMemory();
  right.renderer->DrawOn();
  const long long second = drawn(left).sent;
  right.add(other, 0.3, 0.5, 0.9);
  const Picture expected = capture(left.window);
  const auto expectSame = [&](const std::string& sentence)
  { checks.expect(difference(expected, capture(left.window)).largest == 0, sentence); };
  left.pass->ReleaseGraphicsResources(left.window);
  const long long again = drawn(left).sent;
  checks.expect(second < 10000, "a second renderer finds octrees there");
  checks.expect(again < 10000, "one of both has released them, and they are there");
  expectSame("the same picture");
  for (int pose = 20; pose >= 0; --pose)
  {
    other->SetRadius(0.5 + 0.01 * pose);
    left.window->Render();
  }
  expectSame("what is gone has made room for one, and the other has its octrees");
  const vtkIdType limit = alone - alone / 8; // it had some to spare
  for (Stage* stage : { &left, &right })
  {
    stage->pass->SetGPUMemoryLimit(static_cast<int>(limit));
  }
  expectSame("there is room for the octrees of one at a time");
  const long long each = drawn(left).sent;
  const vtkIdType most = std::max(left.pass->GetGPUMemory(), right.pass->GetGPUMemory());
  std::cout << "two renderers: " << second << " bytes for the second, " << again
            << " again; with room for one " << each << ", " << most << " of " << limit << " KiB\n";
  checks.expect(each > 100000, "they take turns");
  checks.expect(most > 0 && most <= limit, "they stay within the limit");
  right.renderer->SetPass(nullptr);
  right.window->RemoveRenderer(right.renderer);
  left.window->Finalize();
  right.window->AddRenderer(right.renderer);
  right.usePass(true);
  expectSame("in another context");
}
}

int TestSVOTransfers(int, char*[])
{
  Checks checks;
  count(
    "rays", [](vtkSVORenderPass* pass) { pass->SetShadowTechniqueToShadowRays(); }, checks);
  count(
    "maps", [](vtkSVORenderPass* pass) { pass->SetShadowTechniqueToShadowBuffer(); }, checks);
  count(
    "volumes", [](vtkSVORenderPass* pass) { pass->SetShadowTechniqueToShadowVolumes(); }, checks);
  share(checks);
  return checks.exitCode();
}

#else

int TestSVOTransfers(int, char*[])
{
  return VTK_SKIP_RETURN_CODE;
}

#endif
