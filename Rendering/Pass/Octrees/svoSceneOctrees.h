// The octrees of a frame's surfaces: how deep they have to be, and where they come from.
#ifndef svoSceneOctrees_h
#define svoSceneOctrees_h

#include "svoGlyphCopies.h"
#include "svoKeepAlive.h"
#include "svoOctreeStore.h"
#include "svoPlacedShapes.h"
#include "svoPropState.h"
#include "svoScene.h"
#include "svoSurfaceLook.h"
#include "svoTracer.h"
#include "svoView.h"

#include "vtkPolyData.h"
#include "vtkProp.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

class vtkMapper;

namespace svo
{
/// What was written last of a surface's instances, apart from what its prop says.
struct WrittenSurface
{
  std::size_t place = ~std::size_t(0);  // of the first
  std::uint64_t octree = 0, caster = 0; // ids; 0: none
  int neededLevel = 0, coincidentOrder = 0, deepestLevel = 0, detailLevel = 0;
  LeafGeometry leafGeometry = LeafGeometry::Automatic;
  bool visible = false, casts = false;

  auto values() const
  {
    return std::tie(this->place, this->octree, this->caster, this->neededLevel,
      this->coincidentOrder, this->deepestLevel, this->detailLevel, this->leafGeometry,
      this->visible, this->casts);
  }
};

/// An instance in the making, or one for each copy of a glyph.
struct SceneSurface
{
  Instance instance; // of copies all but place, colour and id; its matrix is the actor's
  std::shared_ptr<const GlyphSet> copies; // none: it is there once, as it is
  std::shared_ptr<PlacedShapes> placed;   // of copies that are in the world, and follow
  vtkSmartPointer<vtkPolyData> mesh; // the mesh that only casts, where the surface is not traceable
  bool traceable = false;
  bool casts = false;
  bool translucent = false; // it casts as light as it is

  // Of a frame:
  bool bringsOctree = false;     // `instance.body->octree` is not the store's
  NeededLevels needed;           // of octrees that it does not bring
  WrittenSurface written, shown; // as its instances are; as a frame had them last
  Shared<Body> body;             // as written: that of all its instances, and not `instance.body`

  std::size_t count() const { return this->copies ? this->copies->copies.size() : 1; }
};

/// Why something is not traced, or casts nothing, as sentences for people.
std::string reasons(Reason rasterized, Reason castsNone, bool casts);

/// The surfaces of a prop, and how they are shown.
struct PropSurfaces
{
  vtkWeakPointer<vtkProp> prop;       // another one may come into its place
  glm::dmat4 world{ 1.0 };            // from VTK's world to the scene's; see sceneTransform()
  std::vector<SceneSurface> surfaces; // those that are traceable or cast
  int actors = 0;
  bool traced = true;                    // all that the prop shows can be traced
  bool receives = false;                 // shadows fall on it
  bool reaches = false;                  // what is drawn may reach beyond its bounds
  bool catchesShadows = false;           // of it nothing but these is seen
  bool planes = false;                   // CollectedScene
  bool marked = false;                   // it is meant to be traced, by itself or by all being so
  bool hasPlainMatrix = false;           // of a single actor: it has not changed what is made of it
  Reason rasterized = nullptr;           // why it is not traced
  Reason castsNone = nullptr;            // why something of it casts nothing
  std::vector<const vtkMapper*> mappers; // that VTK draws it with; only compared
  KeepAlive kept;
  PropState state; // when it was collected

  /// VTK's world, where it was collected or has moved to: of what the rasteriser draws, or has no
  /// surfaces.
  std::array<double, 6> bounds{ 1, -1, 1, -1, 1, -1 };
  std::array<double, 6> boundsOfMapper{ 1, -1, 1, -1, 1, -1 }; // of an actor of which that is known

  // Of a frame:
  bool fresh = true;  // collected anew: nothing of its instances has been written
  bool moved = false; // their matrices have not
  bool shown = false; // all of it is traced, with octrees

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
  /// False of a surface whose octree is not there, or not yet.
  bool hasOctrees() const
  {
    return std::all_of(this->surfaces.begin(), this->surfaces.end(),
      [](const SceneSurface& surface) { return static_cast<bool>(surface.instance.body->octree); });
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

/// Where the rasteriser draws something that shadows fall on, as `shown` says: says so to the
/// scene.
void addReceiver(const PropSurfaces& prop, bool shown, Scene& scene);

/// Gives each surface its octrees: those that it brings, or from the store those that the frame
/// needs (Tracer::neededLevels()). Where the store has none, the surface is neither traced nor
/// casts. `instances` are those of the last frame's surfaces; they become this one's.
/// `sameOptions`: those of the last frame.
void findOctrees(std::vector<PropSurfaces>& props, const std::vector<Light>& lights,
  const LevelSettings& settings, OctreeStore& store, const StoreOptions& options, bool sameOptions,
  std::vector<Instance>& instances);
}

#endif
