// The copies that a vtkGlyph3DMapper draws: of which sources, where, and in which colours.
#ifndef svoGlyphCopies_h
#define svoGlyphCopies_h

#include "svoKept.h"
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

class vtkDataObject;
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

/// Follows vtkOpenGLGlyph3DMapper::RebuildStructures. What it computes is kept until the mapper, a
/// data set of its input, its lookup table, its blocks' attributes or the property's colour
/// changes.
class GlyphCopies
{
public:
  /// The mapper's input and sources are up to date. `property` is the actor's.
  Glyphs of(vtkGlyph3DMapper* mapper, vtkProperty* property, Kept& kept);

  /// Drops what nobody keeps.
  void sweep() { this->Entries.sweep(); }

  /// How often copies have been computed, for tests.
  int computed() const { return this->Computed; }

private:
  /// What a data set of the input is shown as.
  struct Block
  {
    unsigned int index = 0;
    bool inTree = false; // colours of highlights are the block's
    bool visible = true;
    glm::dvec3 color{ 1.0 };
    double opacity = 1.0;
  };
  struct Entry
  {
    std::vector<std::shared_ptr<const GlyphSet>> sets;
    Reason beyond = nullptr;
    vtkSmartPointer<vtkPolyDataMapper> colors;
  };
  /// A mapper while it is looked at.
  struct Looking
  {
    vtkGlyph3DMapper* mapper;
    Kept& kept;
    std::vector<std::vector<vtkPolyData*>> sources; // all meshes of each entry of the table
    unsigned int flatIndex = 0;                     // of what is visited next
    Glyphs result;
  };
  void visit(vtkDataObject* input, Block block, Looking& looking);
  void add(vtkDataSet* input, const Block& block, Looking& looking);
  /// The latest time of all that the copies depend on; how many sources; the block's opacity, and
  /// its colour with that.
  using Stamp = std::tuple<vtkMTimeType, std::size_t, double, std::array<unsigned char, 4>>;
  void compute(vtkGlyph3DMapper* mapper, vtkDataSet* input, const Stamp& stamp, Entry& entry);

  KeptValues<std::pair<vtkGlyph3DMapper*, vtkDataSet*>, Entry, Stamp> Entries;
  int Computed = 0;
};
}

#endif
