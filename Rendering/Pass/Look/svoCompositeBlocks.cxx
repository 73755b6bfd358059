#include "svoCompositeBlocks.h"

#include "vtkColorTransferFunction.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeRange.h"
#include "vtkGlyph3DMapper.h"
#include "vtkLookupTable.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkTexture.h"
#include "vtkVersion.h"

// The mapper that draws blocks together lost the number in its name with VTK 9.3, when the one went
// that had the name before and made a mapper for each block.
#include "vtkCompositePolyDataMapper.h"
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
#include "vtkCompositePolyDataMapper2.h"
#endif

#include <algorithm>
#include <iterator>
#include <string>

namespace svo
{
namespace
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
using AttributedMapper = vtkCompositePolyDataMapper;
constexpr const char* CompositeMappers[] = { "vtkCompositePolyDataMapper" };
#else
using AttributedMapper = vtkCompositePolyDataMapper2;
constexpr const char* CompositeMappers[] = { "vtkCompositePolyDataMapper2",
  "vtkCompositePolyDataMapper", "vtkHierarchicalPolyDataMapper" };
#endif

/// The block, else the nearest tree around it, that has a value of its own; nullptr if none has.
template <typename Has>
vtkDataObject* nearest(const std::vector<vtkDataObject*>& path, const Has& has)
{
  const auto found = std::find_if(path.rbegin(), path.rend(), has);
  return found == path.rend() ? nullptr : *found;
}

/// Gives the values of a block that it has of its own to the mapper that colours it.
void applyOwnValues([[maybe_unused]] vtkCompositeDataDisplayAttributes* own,
  [[maybe_unused]] const std::vector<vtkDataObject*>& path,
  [[maybe_unused]] vtkPolyDataMapper* mapper)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  using Own = vtkCompositeDataDisplayAttributes;
  const auto apply = [&](bool (Own::*has)(vtkDataObject*) const, const auto& set)
  {
    if (vtkDataObject* object =
          nearest(path, [&](vtkDataObject* candidate) { return (own->*has)(candidate); }))
    {
      set(object);
    }
  };
  apply(&Own::HasBlockScalarVisibility,
    [&](vtkDataObject* o) { mapper->SetScalarVisibility(own->GetBlockScalarVisibility(o)); });
  apply(&Own::HasBlockScalarMode,
    [&](vtkDataObject* o) { mapper->SetScalarMode(own->GetBlockScalarMode(o)); });
  apply(&Own::HasBlockArrayAccessMode,
    [&](vtkDataObject* o) { mapper->SetArrayAccessMode(own->GetBlockArrayAccessMode(o)); });
  apply(&Own::HasBlockArrayName,
    [&](vtkDataObject* o) { mapper->SetArrayName(own->GetBlockArrayName(o).c_str()); });
  apply(
    &Own::HasBlockArrayId, [&](vtkDataObject* o) { mapper->SetArrayId(own->GetBlockArrayId(o)); });
  apply(&Own::HasBlockArrayComponent,
    [&](vtkDataObject* o) { mapper->SetArrayComponent(own->GetBlockArrayComponent(o)); });
  apply(&Own::HasBlockFieldDataTupleId,
    [&](vtkDataObject* o) { mapper->SetFieldDataTupleId(own->GetBlockFieldDataTupleId(o)); });
  apply(&Own::HasBlockColorMode,
    [&](vtkDataObject* o) { mapper->SetColorMode(own->GetBlockColorMode(o)); });
  apply(&Own::HasBlockLookupTable,
    [&](vtkDataObject* o) { mapper->SetLookupTable(own->GetBlockLookupTable(o)); });
  apply(&Own::HasBlockScalarRange,
    [&](vtkDataObject* o) { mapper->SetScalarRange(own->GetBlockScalarRange(o).GetData()); });
  apply(&Own::HasBlockUseLookupTableScalarRange,
    [&](vtkDataObject* o)
    { mapper->SetUseLookupTableScalarRange(own->GetBlockUseLookupTableScalarRange(o)); });
  apply(&Own::HasBlockInterpolateScalarsBeforeMapping,
    [&](vtkDataObject* o) {
      mapper->SetInterpolateScalarsBeforeMapping(own->GetBlockInterpolateScalarsBeforeMapping(o));
    });
#endif
}

vtkTexture* textureOf([[maybe_unused]] vtkCompositeDataDisplayAttributes* own,
  [[maybe_unused]] const std::vector<vtkDataObject*>& path)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  vtkDataObject* object =
    nearest(path, [&](vtkDataObject* candidate) { return own->HasBlockTexture(candidate); });
  return object ? own->GetBlockTexture(object).Get() : nullptr;
#else
  return nullptr;
#endif
}

/// The array that a block is coloured by.
vtkAbstractArray* scalarsOf(vtkPolyDataMapper* mapper, vtkDataSet* mesh)
{
  int cells = 0;
  return vtkAbstractMapper::GetAbstractScalars(mesh, mapper->GetScalarMode(),
    mapper->GetArrayAccessMode(), mapper->GetArrayId(), mapper->GetArrayName(), cells);
}

/// True if the colour given to a block, or to a tree around it, counts for more than its scalars.
bool colorWins([[maybe_unused]] vtkCompositeDataDisplayAttributes* own,
  [[maybe_unused]] vtkDataObject* block, [[maybe_unused]] vtkMapper* mapper,
  [[maybe_unused]] bool hasScalars)
{
  // First it always did; VTK's rule is another one from the 12th of April 2024 on.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 20240412)
  return !hasScalars ||
    !(own->HasBlockScalarVisibility(block) ? own->GetBlockScalarVisibility(block)
                                           : mapper->GetScalarVisibility() != 0);
#else
  return true;
#endif
}

/// The colour of NaN of the two kinds of tables that VTK's mapper asks for it.
bool nanColor(vtkScalarsToColors* colors, double color[3])
{
  if (auto* table = vtkLookupTable::SafeDownCast(colors))
  {
    std::copy_n(table->GetNanColor(), 3, color);
    return true;
  }
  if (auto* function = vtkColorTransferFunction::SafeDownCast(colors))
  {
    function->GetNanColor(color);
    return true;
  }
  return false;
}

template <typename Color>
void overrideColor(const Color& color, SurfacePart& part)
{
  part.overridesColor = true;
  part.color = { color[0], color[1], color[2] };
}
}

vtkCompositeDataDisplayAttributes* attributesOf(vtkMapper* mapper)
{
  if (auto* attributed = AttributedMapper::SafeDownCast(mapper))
  {
    return attributed->GetCompositeDataDisplayAttributes();
  }
  auto* glyphs = vtkGlyph3DMapper::SafeDownCast(mapper);
  return glyphs ? glyphs->GetBlockAttributes() : nullptr;
}

bool isCompositeMapper(vtkMapper* mapper)
{
  const std::string name = mapper->GetClassName();
  return std::find(std::begin(CompositeMappers), std::end(CompositeMappers), name) !=
    std::end(CompositeMappers);
}

bool hasMeshes(vtkMapper* mapper)
{
  return !vtkCompositeDataSet::GetDataSets<vtkPolyData>(mapper->GetInputDataObject(0, 0)).empty();
}

vtkPolyDataMapper* CompositeBlocks::colorsOf(vtkMapper* mapper, const Path& path, KeepAlive& kept)
{
  auto* attributes = attributesOf(mapper);
  const vtkMTimeType time = std::max(mapper->GetMTime(), timeOf(attributes));
  const auto make = [&](vtkSmartPointer<vtkPolyDataMapper>& colors)
  {
    colors = colors ? colors : vtkSmartPointer<vtkPolyDataMapper>::New();
    colors->vtkMapper::ShallowCopy(mapper);
    colors->SetInputData(vtkPolyData::SafeDownCast(path.back()));
    if (attributes)
    {
      applyOwnValues(attributes, path, colors);
    }
  };
  return this->Blocks.of({ mapper, path.back() }, time, kept, make);
}

SurfacePart CompositeBlocks::partOf(
  vtkMapper* mapper, const Path& path, double opacity, KeepAlive& kept)
{
  SurfacePart part;
  part.mesh = vtkPolyData::SafeDownCast(path.back());
  part.opacity = opacity;
  vtkPolyDataMapper* colors = this->colorsOf(mapper, path, kept);
  part.colors = colors;
  const bool hasScalars = scalarsOf(colors, part.mesh) != nullptr;
  if (auto* own = attributesOf(mapper))
  {
    if (vtkDataObject* object =
          nearest(path, [&](vtkDataObject* o) { return own->HasBlockOpacity(o); }))
    {
      part.opacity = own->GetBlockOpacity(object);
    }
    vtkDataObject* object = nearest(path, [&](vtkDataObject* o) { return own->HasBlockColor(o); });
    if (object && colorWins(own, part.mesh, mapper, hasScalars))
    {
      overrideColor(own->GetBlockColor(object), part);
    }
    part.texture = textureOf(own, path);
  }
  // Blocks that lack the array the others are coloured by take the table's colour of NaN, if asked.
  double nan[3];
  auto* attributed = AttributedMapper::SafeDownCast(mapper);
  if (attributed && attributed->GetColorMissingArraysWithNanColor() &&
    colors->GetScalarVisibility() && !hasScalars && nanColor(colors->GetLookupTable(), nan))
  {
    overrideColor(nan, part);
  }
  return part;
}

void CompositeBlocks::visit(vtkMapper* mapper, Path& path, unsigned int& flatIndex, double opacity,
  std::vector<SurfacePart>& parts, KeepAlive& kept)
{
  const unsigned int index = flatIndex++;
  if (auto* tree = vtkDataObjectTree::SafeDownCast(path.back()))
  {
    for (vtkDataObject* child : vtk::Range(tree, vtk::DataObjectTreeOptions::None))
    {
      if (!child)
      {
        ++flatIndex;
        continue;
      }
      path.push_back(child);
      this->visit(mapper, path, flatIndex, opacity, parts, kept);
      path.pop_back();
    }
  }
  else if (vtkPolyData::SafeDownCast(path.back()))
  {
    auto* own = attributesOf(mapper);
    vtkDataObject* object =
      own ? nearest(path, [&](vtkDataObject* o) { return own->HasBlockVisibility(o); }) : nullptr;
    if (!object || own->GetBlockVisibility(object))
    {
      parts.push_back(this->partOf(mapper, path, opacity, kept));
      parts.back().block = index;
    }
  }
}

std::vector<SurfacePart> CompositeBlocks::partsOf(
  vtkMapper* mapper, double opacity, KeepAlive& kept)
{
  std::vector<SurfacePart> parts;
  if (vtkDataObject* root = mapper->GetInputDataObject(0, 0))
  {
    Path path{ root };
    unsigned int flatIndex = 0;
    this->visit(mapper, path, flatIndex, opacity, parts, kept);
  }
  return parts;
}
}
