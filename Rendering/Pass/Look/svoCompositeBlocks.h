// The visible blocks of a composite mapper, and the look of each by the mapper's attributes.
#ifndef svoCompositeBlocks_h
#define svoCompositeBlocks_h

#include "svoKeepAlive.h"
#include "svoSurfaceLook.h"

#include "vtkSmartPointer.h"

#include <utility>
#include <vector>

class vtkCompositeDataDisplayAttributes;
class vtkDataObject;
class vtkMapper;
class vtkPolyDataMapper;

namespace svo
{
/// Whether a mapper is of a class that draws the blocks of a tree by known rules.
bool isCompositeMapper(vtkMapper* mapper);

/// Whether there is a mesh among the blocks of a composite mapper. Of others VTK draws nothing.
bool hasMeshes(vtkMapper* mapper);

/// What a mapper, composite or of glyphs, says of single blocks; null if it says nothing.
vtkCompositeDataDisplayAttributes* attributesOf(vtkMapper* mapper);

/// A composite mapper has one set of colours, but blocks need theirs at the same time: each gets a
/// mapper of its own, for as long as somebody keeps it.
class CompositeBlocks
{
public:
  /// The mapper's visible blocks, in the order of their flat indices. `opacity` is the property's.
  /// Attributes are those of the block, else of the nearest tree around it that has some, else the
  /// mapper's (vtkCompositePolyDataMapper::BuildRenderValues).
  std::vector<SurfacePart> partsOf(vtkMapper* mapper, double opacity, KeepAlive& kept);

  /// Drops what nobody keeps.
  void sweep() { this->Blocks.sweep(); }

private:
  using Path = std::vector<vtkDataObject*>; // from the root to a block
  void visit(vtkMapper* mapper, Path& path, unsigned int& flatIndex, double opacity,
    std::vector<SurfacePart>& parts, KeepAlive& kept);
  SurfacePart partOf(vtkMapper* mapper, const Path& path, double opacity, KeepAlive& kept);
  vtkPolyDataMapper* colorsOf(vtkMapper* mapper, const Path& path, KeepAlive& kept);

  CachedValues<std::pair<vtkMapper*, vtkDataObject*>, vtkSmartPointer<vtkPolyDataMapper>> Blocks;
};
}

#endif
