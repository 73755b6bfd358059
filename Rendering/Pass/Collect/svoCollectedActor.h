// An actor whose surfaces are being collected, and what of a surface casts: its opaque cells, and
// beside them what is translucent.
#ifndef svoCollectedActor_h
#define svoCollectedActor_h

#include "svoOpaqueCells.h"
#include "svoPropKeys.h"
#include "svoSceneOctrees.h"
#include "svoSurfaceLook.h"
#include "svoView.h"

#include "vtkActor.h"

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <tuple>

#include <glm/mat4x4.hpp>

class vtkPolyData;

namespace svo
{
/// How props are collected. Where one of these changes, all of them are collected again.
struct PropChoices
{
  bool shadows = true; // casters are wanted, and a light casts, or for what is all around
  bool lights = false; // there are lights at all
  /// Only props that say explicitly that they use octrees (vtkSVORenderPass::SetUseSVO) are traced
  /// and cast. The others only receive, unless they are treated likewise; about them there are no
  /// messages.
  bool onlyMarked = false;
  bool unmarkedToo = false;
  bool translucentShadows = false; // what is translucent casts as well, as light as it is
  bool meanOpacity = false;        // ... each surface equally all over
  /// The rasteriser draws all that is seen but actors of planes alone.
  bool openGL = false;
  glm::dmat4 world{ 1.0 }; // see sceneTransform()

  auto values() const
  {
    return std::tie(this->shadows, this->lights, this->onlyMarked, this->unmarkedToo,
      this->translucentShadows, this->meanOpacity, this->openGL, this->world);
  }
};

/// What a frame's collection of its props depends on, apart from the props.
struct CollectProps : PropChoices
{
  Reason notMarked = "was not chosen with SetUseSVO"; // why the others are not traced
  std::function<void(const std::string&)> complain;   // each message once
  std::set<std::string>* said = nullptr; // messages of the pass, about no object in particular
  /// Messages about surfaces and cells that cast nothing, or more than they show; empty: none.
  std::string translucentSurfaceText;
  std::string translucentText;
  std::string cutOutText;
  const View* eye = nullptr; // null: not known
};

/// What of a part casts; null: nothing.
struct Casters
{
  vtkPolyData* opaque = nullptr;
  vtkPolyData* translucent = nullptr;
};

struct CollectedActor
{
  vtkActor* actor;
  PropSurfaces& found; // of its prop
  const CollectProps& frame;
  bool quiet = false;             // there are no messages about it
  bool traceable = false;         // on the CPU, as far as that does not depend on its surfaces
  bool planes = false;            // OpenGL traces it: it is the prop, and all of it are planes
  Reason beyond = nullptr;        // why it can only cast
  glm::dmat4 localToWorld{ 1.0 }; // fit for tracing

  bool flag(vtkInformationIntegerKey* key, bool otherwise) const
  {
    return flagOf(this->actor, this->found.prop, key, otherwise);
  }

  /// Gives a message about no object in particular, once for all renderers.
  void complain(const std::string& text) const;

  Casters castersOf(const SurfacePart& part, OpaqueAnswer opaque) const;

  /// Adds a surface that is traced, or else casts, with what it has of its actor. `mark`: what its
  /// id differs by from that of others of the part.
  void add(
    const SurfacePart& part, Reason reason, SceneSurface& surface, std::uint64_t mark = 0) const;

  /// The same of what casts as light as it is, which is never traced itself.
  void addTranslucent(const SurfacePart& part, SceneSurface& surface, std::uint64_t mark = 0) const;
};
}

#endif
