// The surfaces of a renderer's props, and how each is shown: traced, rasterised, casting.
#ifndef svoPropCollector_h
#define svoPropCollector_h

#include "svoCompositeBlocks.h"
#include "svoDataSetSurfaces.h"
#include "svoFloatArrays.h"
#include "svoGlyphCopies.h"
#include "svoLeafMeshes.h"
#include "svoOpaqueCells.h"
#include "svoSceneOctrees.h"
#include "svoSeenFaces.h"
#include "svoSurfaceLook.h"
#include "svoUnitShapes.h"
#include "svoView.h"

#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/mat4x4.hpp>

class vtkActor;
class vtkMatrix4x4;
class vtkObject;
class vtkPolyData;
class vtkProp;

namespace svo
{
/// How props are collected. Where one of these is not what it was, all of them are collected again.
struct PropChoices
{
  bool shadows = true; // casters are wanted, and a light casts
  bool lights = false; // there are lights at all
  /// Only props that say explicitly that they use octrees (vtkSVORenderPass::SetUseSVO) are traced
  /// and cast. The others only receive, unless they are treated likewise; about them there are no
  /// messages.
  bool onlyMarked = false;
  bool unmarkedToo = false;
  bool translucentShadows = false; // what is translucent casts as well, as light as it is
  bool meanOpacity = false;        // ... each surface equally all over
  bool onlyCast = false;           // nothing is traced; the rasteriser draws all that is seen
  glm::dmat4 world{ 1.0 };         // see sceneTransform()

  auto values() const
  {
    return std::tie(this->shadows, this->lights, this->onlyMarked, this->unmarkedToo,
      this->translucentShadows, this->meanOpacity, this->onlyCast, this->world);
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

/// Whether a prop can have surfaces: actors and assemblies of them.
bool canCollect(vtkProp* prop);

/// Has what was computed of the props' data for as long as one of them keeps it.
class PropCollector
{
public:
  /// Fills in the surfaces of `found.prop`, without octrees. The prop can have some.
  void collect(PropSurfaces& found, const CollectProps& frame);

  /// Of an actor that has moved since it was collected, and else is what it was, sets the matrices.
  /// False if it has to be collected again: nothing has been done then.
  static bool move(PropSurfaces& found, const CollectProps& frame);

  /// Puts the shapes of collected props in their places: of props that are fresh or have moved, and
  /// unless `sameEye` those with a width in pixels.
  static void place(std::vector<PropSurfaces>& props, const View& eye, bool sameEye);

  /// Forgets what no collected prop keeps any more.
  void sweep();

private:
  void collectActor(
    vtkActor* actor, const vtkMatrix4x4* matrix, PropSurfaces& found, const CollectProps& frame);
  bool placeOf(vtkActor* actor, const vtkMatrix4x4* matrix, glm::dmat4& localToWorld,
    Reason& beyond, PropSurfaces& found, const CollectProps& frame);
  std::vector<SurfacePart> partsOf(vtkActor* actor, Kept& kept);
  void collectPart(vtkActor* actor, SurfacePart& part, const glm::dmat4& localToWorld,
    Reason beyond, PropSurfaces& found, const CollectProps& frame);
  void collectGlyphs(vtkActor* actor, const glm::dmat4& localToWorld, Reason beyond,
    PropSurfaces& found, const CollectProps& frame);
  void collectRoundShapes(vtkActor* actor, const glm::dmat4& localToWorld, Reason beyond,
    PropSurfaces& found, const CollectProps& frame);
  void collectSplats(vtkActor* actor, const glm::dmat4& localToWorld, Reason beyond,
    PropSurfaces& found, const CollectProps& frame);
  bool collectTubes(vtkActor* actor, const SurfacePart& part, const Attributes& attributes,
    const glm::dmat4& localToWorld, Reason beyond, PropSurfaces& found, const CollectProps& frame);
  void addRoundShapes(vtkActor* actor, const std::shared_ptr<RoundShapes>& shapes, bool translucent,
    const SurfacePart& of, const glm::dmat4& localToWorld, Reason reason, PropSurfaces& found,
    const CollectProps& frame);
  bool finish(vtkActor* actor, const SurfacePart& part, const glm::dmat4& localToWorld,
    Reason reason, SceneSurface& surface, PropSurfaces& found);
  /// What of a part casts; null: nothing.
  struct Casters
  {
    vtkPolyData* opaque = nullptr;
    vtkPolyData* translucent = nullptr;
  };
  Casters castersOf(const SurfacePart& part, OpaqueCells::Answer opaque, vtkActor* actor,
    PropSurfaces& found, const CollectProps& frame);
  Casters seenOf(const Casters& casters, vtkActor* actor, const glm::dmat4& localToWorld,
    PropSurfaces& found, const CollectProps& frame);
  void addTranslucent(vtkActor* actor, const SurfacePart& part, const glm::dmat4& localToWorld,
    SceneSurface& surface, PropSurfaces& found);
  void complainOnce(vtkObject* about, const std::string& text, const CollectProps& frame);

  CompositeBlocks Blocks;
  DataSetSurfaces Surfaces;
  GlyphCopies Copies;
  OpaqueCells Opaque;
  FloatArrays Floats;
  LeafMeshes Leaves;
  SeenFaces Seen;
  std::shared_ptr<UnitShapes> Shapes = UnitShapes::ofAll();
  std::map<std::pair<vtkObject*, std::string>, vtkWeakPointer<vtkObject>>
    GivenMessages;    // by object
  bool Quiet = false; // about the actor that is being collected
};
}

#endif
