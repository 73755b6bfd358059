// The octrees of a frame's surfaces: how deep they have to be, and where they come from.
#ifndef svoSceneOctrees_h
#define svoSceneOctrees_h

#include "svoGlyphCopies.h"
#include "svoOctreeStore.h"
#include "svoScene.h"
#include "svoSurfaceLook.h"
#include "svoTracer.h"
#include "svoView.h"

#include "vtkPolyData.h"
#include "vtkProp.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

namespace svo
{
/// An instance in the making, or one for each copy of a glyph.
struct SceneSurface
{
  Instance instance; // of copies all but place, colour and id; its matrix is the actor's
  std::shared_ptr<const GlyphSet> copies; // none: it is there once, as it is
  vtkSmartPointer<vtkPolyData> mesh; // the mesh that only casts, where the surface is not traceable
  bool traceable = false;
  bool casts = false;

  std::size_t count() const { return this->copies ? this->copies->copies.size() : 1; }
  /// Adds the instances to a scene's.
  void addTo(std::vector<Instance>& instances) const;
};

/// The surfaces of a prop, and how they are shown.
struct PropSurfaces
{
  vtkSmartPointer<vtkProp> prop;
  glm::dmat4 world{ 1.0 };            // from VTK's world to the scene's; see sceneTransform()
  std::vector<SceneSurface> surfaces; // those that are traceable or cast
  int actors = 0;
  bool traced = true;                               // all that the prop shows is traced
  bool receives = false;                            // shadows fall on it
  Reason rasterized = nullptr;                      // why it is not traced
  Reason castsNone = nullptr;                       // why something of it casts nothing
  std::vector<vtkSmartPointer<vtkObjectBase>> kept; // owners of arrays that the surfaces point into

  /// Leaves the prop to the rasteriser.
  void rasterize(Reason reason)
  {
    this->traced = false;
    this->rasterized = this->rasterized ? this->rasterized : reason;
  }
  void castNothing(Reason reason) { this->castsNone = this->castsNone ? this->castsNone : reason; }
  bool casts() const
  {
    return std::any_of(this->surfaces.begin(), this->surfaces.end(),
      [](const SceneSurface& surface) { return surface.casts; });
  }
  void leaveAlone(Reason reason)
  {
    this->rasterize(reason);
    this->castNothing(reason);
  }
};

/// The inputs of Tracer::neededLevels() for octrees that are built here.
struct LevelSettings
{
  View eye; // with a pixel for each of the window's; no pixels: not known
  FrameSettings frame;
  const Tracer* tracer = nullptr; // asked where octrees have to be built
};

/// Where the rasteriser draws something that shadows fall on: says so to the scene.
void addReceiver(const PropSurfaces& prop, Scene& scene);

/// Gives each surface its octrees: those that it brings, or from the store those that the frame
/// needs (Tracer::neededLevels()). Where the store has none, the surface is neither traced nor
/// casts.
void findOctrees(std::vector<PropSurfaces>& props, const std::vector<Light>& lights,
  const LevelSettings& settings, OctreeStore& store, const StoreOptions& options);
}

#endif
