// The surfaces of a renderer's props, and how each is shown: traced, rasterised, casting.
#ifndef svoPropCollector_h
#define svoPropCollector_h

#include "svoCollectedActor.h"
#include "svoCompositeBlocks.h"
#include "svoDataSetSurfaces.h"
#include "svoFloatArrays.h"
#include "svoGlyphCopies.h"
#include "svoLeafMeshes.h"
#include "svoOpaqueCells.h"
#include "svoSeenFaces.h"
#include "svoUnitShapes.h"

#include "vtkWeakPointer.h"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

class vtkActor;
class vtkMatrix4x4;
class vtkObject;
class vtkProp;

namespace svo
{
/// Whether a prop can have surfaces: actors and assemblies of them.
bool canCollect(vtkProp* prop);

/// Has what was computed of the props' data for as long as one of them keeps it.
class PropCollector
{
public:
  /// Fills in the surfaces of `found.prop`, without octrees. The prop can have some.
  void collect(PropSurfaces& found, const CollectProps& frame);

  /// Of an actor that has moved since it was collected, and is unchanged otherwise, sets the
  /// matrices. False if it has to be collected again: nothing has been done then.
  static bool move(PropSurfaces& found, const CollectProps& frame);

  /// Forgets what no collected prop keeps any more.
  void sweep();

private:
  void collectActor(
    vtkActor* actor, const vtkMatrix4x4* matrix, PropSurfaces& found, const CollectProps& frame);
  bool place(CollectedActor& of, const vtkMatrix4x4* matrix);
  std::vector<SurfacePart> partsOf(vtkActor* actor, KeepAlive& kept);
  void collectPart(const CollectedActor& of, SurfacePart& part);
  void collectGlyphs(const CollectedActor& of);
  Casters seenOf(const Casters& casters, const CollectedActor& of);
  void complainOnce(const CollectedActor& of, const std::string& text);

  CompositeBlocks Blocks;
  DataSetSurfaces Surfaces;
  GlyphCopies Copies;
  OpaqueCells Opaque;
  FloatArrays Floats;
  LeafMeshes Leaves;
  SeenFaces Seen;
  std::shared_ptr<UnitShapes> Shapes = UnitShapes::ofAll();
  std::map<std::pair<vtkObject*, std::string>, vtkWeakPointer<vtkObject>>
    GivenMessages; // by object
};
}

#endif
