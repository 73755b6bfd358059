// A renderer's visible surfaces and lights as a scene of the tracer.
#ifndef svoSceneCollector_h
#define svoSceneCollector_h

#include "svoOctreeStore.h"
#include "svoPropCollector.h"
#include "svoScene.h"
#include "svoSceneLights.h"
#include "svoSceneOctrees.h"

#include "vtkProp.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

class vtkPolyData;
class vtkRenderer;

namespace svo
{
/// A frame's settings of the collection. `notMarked` need not outlive the call; `shadows` says that
/// casters are wanted. Lights, the world, the eye and who hears messages are the collector's
/// affair.
struct CollectSettings : CollectProps
{
  LevelSettings levels;
  LightWords lightWords;
};

/// A frame's scene, and the renderer's props that the scene replaces.
struct CollectedScene
{
  Scene scene;
  bool current = false; // of this frame; what is kept of an earlier one is not to be used
  std::size_t own = 0;  // number of instances that come from this renderer
  std::vector<vtkPolyData*> meshes; // of the scene's own instances, by index
  std::vector<vtkProp*> props;      // likewise
  /// Props that the rasteriser must leave alone: every surface of theirs is traced, or must not be
  /// shown.
  std::set<vtkProp*> replaced;
  /// Those that the rasteriser draws and shadows fall on, catchers of shadows among them; with
  /// `openGL` what is traced, too.
  std::set<vtkProp*> receivers;
  int tracedActors = 0;
  int rasterizedActors = 0;
  bool rasterizedReceivers = false; // lit surfaces that the rasteriser draws and shadows fall on
  bool receiversReach = false;      // some of them may reach beyond Scene::receivers
  bool shadowCatchers = false;      // there are some; they are rasterised
  bool marked = false;              // something is meant to be traced, or to cast as if it were
  /// Surfaces without triangles are there, and may be traced, of which VTK would draw a contour
  /// with `openGL`. Whether it does does not matter.
  bool planes = false;
  /// Where lights cast and yet no shadow can be seen: why, as ends of sentences that begin with
  /// "it", and of how many props. Empty where some can, where there is nothing, and where somebody
  /// asked for that.
  std::string nothingCasts, nothingReceives;
  int withoutShadows = 0;
  bool clippedCastNone = false; // something is clipped by its mapper, and casts nothing for that
  LightNotes lights;
  /// With `onlyMarked`: why marked props are not traced, and what casts nothing. Others are not in.
  std::vector<std::pair<vtkWeakPointer<vtkProp>, std::string>> reasons;
};

/// What a renderer has, held: updating a prop may change its list, or let props go.
std::vector<vtkSmartPointer<vtkProp>> propsOf(vtkRenderer* renderer);

/// Collects frame after frame from one renderer. Casters outside of the picture are in. Whatever is
/// unchanged since the last frame is neither collected nor written again: props (svoPropState.h),
/// octrees, and the scene's instances.
class SceneCollector
{
public:
  /// Octrees come from `store`; messages go to `options.complain`, each once. `result` is what the
  /// last call has made, or new after forget().
  void collect(vtkRenderer* renderer, OctreeStore& store, const StoreOptions& options,
    const CollectSettings& settings, CollectedScene& result);

  /// The surfaces that a frame would collect of a prop, octrees apart, if a light casts. Gives no
  /// messages.
  PropSurfaces judge(vtkProp* prop);

  /// Props that the last frame had to look at anew, for tests.
  int collectedAnew() const { return this->Anew; }

  /// Frees what is kept for the next frame. What was collected must not be used any more.
  void forget();

private:
  bool collectProps(
    const std::vector<vtkSmartPointer<vtkProp>>& props, const CollectProps& frame, bool all);
  void assemble(CollectedScene& result);
  void explain(
    const CollectSettings& settings, const StoreOptions& options, CollectedScene& result) const;
  void missShadows(const StoreOptions& options, CollectedScene& result) const;

  PropCollector Props;
  std::vector<PropSurfaces> Found; // of the last frame's visible props, in their order
  int Others = 0;                  // its visible props in space that can have no surfaces
  /// Of all surfaces of those props; where all are in the scene they are lent to it.
  std::vector<Instance> Instances;
  std::uint64_t Version = 0; // Scene::version of what was made of them
  bool Lent = false;
  // The rest of what they depend on.
  bool Collected = false;
  PropChoices Choices;
  std::string NotMarked; // what reasons of kept props point to
  LevelSettings Levels;
  StoreOptions Options;
  std::uint64_t StoreVersion = 0;
  bool Complete = false; // all surfaces have octrees
  bool Placed = false;   // some have shapes that are put in their places
  int Anew = 0;
};
}

#endif
