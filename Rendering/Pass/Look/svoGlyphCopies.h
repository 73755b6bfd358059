// The copies that a vtkGlyph3DMapper draws: of which sources, where, and in which colours.
#ifndef svoGlyphCopies_h
#define svoGlyphCopies_h

#include "svoKeepAlive.h"
#include "svoSurfaceLook.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

class vtkDataSet;
class vtkGlyph3DMapper;
class vtkMapper;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkProperty;

namespace svo
{
/// One copy of a source.
struct GlyphCopy
{
  glm::dmat4x3 place; // affine: source -> the mapper's input; finite, not all zero
  std::array<unsigned char, 4> color{};
  std::int64_t point = 0; // of the input
};

/// The copies of one source that an input places.
struct GlyphSet
{
  std::size_t source = 0; // index into the mapper's table
  std::vector<GlyphCopy> copies;
  bool opaque = true;     // all of the copies' colours are
  double condition = 1.0; // at least that of any of the matrices; see kindOf()
};

/// What a mapper draws.
struct Glyphs
{
  struct Drawn
  {
    vtkPolyData* mesh; // the source, or a part of it
    std::shared_ptr<const GlyphSet> set;
    unsigned int block;     // flat index of the input in its tree
    bool overridesSpecular; // blocks of a tree have their colour as that of highlights, too
    glm::vec3 specular;
  };
  std::vector<Drawn> drawn; // in VTK's order
  Reason beyond = nullptr;  // why that is not known; then there are none
};

/// True for the class that draws copies by known rules.
bool isGlyphMapper(vtkMapper* mapper);

/// True if all that it copies are surfaces without triangles.
bool copiesPlanes(vtkGlyph3DMapper* mapper);

/// What one data set of a mapper's input places.
struct PlacedGlyphs
{
  std::vector<std::shared_ptr<const GlyphSet>> sets;
  Reason beyond = nullptr;
  vtkSmartPointer<vtkPolyDataMapper> colors;
};
/// The latest time of all that these depend on; how many sources; the opacity of the data set's
/// block, and its colour with that.
using GlyphStamp = std::tuple<vtkMTimeType, std::size_t, double, std::array<unsigned char, 4>>;

/// Kept until the mapper, a data set of its input, its lookup table, its blocks' attributes or the
/// property's colour changes.
using GlyphCopies =
  CachedValues<std::pair<vtkGlyph3DMapper*, vtkDataSet*>, PlacedGlyphs, GlyphStamp>;

/// Follows vtkOpenGLGlyph3DMapper::RebuildStructures. The mapper's input and sources are up to
/// date. `property` is the actor's.
Glyphs glyphsOf(
  vtkGlyph3DMapper* mapper, vtkProperty* property, GlyphCopies& copies, KeepAlive& kept);
}

#endif
