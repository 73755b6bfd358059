// The blocks of a composite mapper, and what its attributes say about the look of each.
#ifndef svoCompositeBlocks_h
#define svoCompositeBlocks_h

#include "svoSurfaceLook.h"

#include "vtkSmartPointer.h"
#include "vtkVersion.h"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

class vtkDataObject;
class vtkPolyDataMapper;

// The mapper that draws blocks together lost the number in its name with VTK 9.3, when another one
// went that had the name before.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
class vtkCompositePolyDataMapper;
namespace svo
{
using CompositeMapper = vtkCompositePolyDataMapper;
constexpr const char* CompositeMapperName = "vtkCompositePolyDataMapper";
}
#else
class vtkCompositePolyDataMapper2;
namespace svo
{
using CompositeMapper = vtkCompositePolyDataMapper2;
constexpr const char* CompositeMapperName = "vtkCompositePolyDataMapper2";
}
#endif

namespace svo
{
/// The mapper as a composite one whose drawing is known; nullptr if it is none. Subclasses count.
CompositeMapper* compositeMapper(vtkMapper* mapper);

/// A composite mapper has one set of colours, but blocks need theirs at the same time: each gets a
/// mapper of its own, kept from frame to frame.
class CompositeBlocks
{
public:
  /// The mapper's visible blocks, in the order of their flat indices. `opacity` is the property's.
  /// Attributes are those of the block, else of the nearest tree around it that has some, else the
  /// mapper's (vtkCompositePolyDataMapper::BuildRenderValues).
  std::vector<SurfacePart> partsOf(CompositeMapper* mapper, double opacity);

  /// Forgets what was not asked for since the last call.
  void endFrame();

private:
  using Path = std::vector<vtkDataObject*>; // from the root to a block
  void visit(CompositeMapper* mapper, Path& path, unsigned int& flatIndex, double opacity,
    std::vector<SurfacePart>& parts);
  SurfacePart partOf(CompositeMapper* mapper, const Path& path, double opacity);
  vtkPolyDataMapper* colorsOf(CompositeMapper* mapper, const Path& path);

  struct Colors
  {
    vtkSmartPointer<vtkPolyDataMapper> mapper;
    std::uint64_t time = 0;
    bool used = false;
  };
  std::map<std::pair<vtkMapper*, vtkDataObject*>, Colors> Blocks;
};
}

#endif
