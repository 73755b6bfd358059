#include "svoGlyphCopies.h"

#include "svoGlyphPlaces.h"

#include "vtkBitArray.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeRange.h"
#include "vtkDataSet.h"
#include "vtkGlyph3DMapper.h"
#include "vtkMath.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVersion.h"

#include <algorithm>
#include <string>

namespace svo
{
namespace
{
/// The mapper tells its subclasses only which arrays it reads.
struct Asking : public vtkGlyph3DMapper
{
  using vtkGlyph3DMapper::GetMaskArray;
  using vtkGlyph3DMapper::GetSourceIndexArray;
};

/// The table's entries; null where there is none.
std::vector<vtkDataObject*> sourcesOf(vtkGlyph3DMapper* mapper)
{
  std::vector<vtkDataObject*> sources;
  if (!mapper->GetUseSourceTableTree())
  {
    for (int i = 0; i < mapper->GetNumberOfInputConnections(1); ++i)
    {
      sources.push_back(mapper->GetSource(i));
    }
    return sources;
  }
  if (vtkDataObjectTree* tree = mapper->GetSourceTableTree())
  {
    for (vtkDataObject* child : vtk::Range(tree, vtk::DataObjectTreeOptions::SkipEmptyNodes))
    {
      sources.push_back(child);
    }
  }
  return sources;
}

/// What the mapper draws of one entry of its table.
std::vector<vtkPolyData*> leavesOf(vtkDataObject* source)
{
  std::vector<vtkPolyData*> leaves = vtkCompositeDataSet::GetDataSets<vtkPolyData>(source);
  const auto isEmpty = [](vtkPolyData* mesh) { return mesh->GetNumberOfPoints() == 0; };
  leaves.erase(std::remove_if(leaves.begin(), leaves.end(), isEmpty), leaves.end());
  return leaves;
}

std::array<unsigned char, 4> bytesOf(const glm::dvec3& color, double opacity)
{
  const auto byte = [](double value) { return static_cast<unsigned char>(value * 255.0 + 0.5); };
  return { byte(color.x), byte(color.y), byte(color.z), byte(opacity) };
}

/// What a data set of the input is shown as.
struct Block
{
  unsigned int index = 0;
  bool inTree = false; // colours of highlights are the block's
  bool visible = true;
  glm::dvec3 color{ 1.0 };
  double opacity = 1.0;
};
/// A mapper while it is looked at.
struct Looking
{
  vtkGlyph3DMapper* mapper;
  GlyphCopies& copies;
  Kept& kept;
  std::vector<std::vector<vtkPolyData*>> sources; // all meshes of each entry of the table
  unsigned int flatIndex = 0;                     // of what is visited next
  Glyphs result;
};

void compute(
  vtkGlyph3DMapper* mapper, vtkDataSet* input, const GlyphStamp& stamp, PlacedGlyphs& entry)
{
  const auto& [time, sources, opacity, color] = stamp;
  entry.sets.clear();
  entry.beyond = nullptr;
  const vtkIdType points = input->GetNumberOfPoints();
  const GlyphPlaces places(mapper, input);
  vtkDataArray* indices = (mapper->*(&Asking::GetSourceIndexArray))(input);
  auto* mask = vtkBitArray::SafeDownCast((mapper->*(&Asking::GetMaskArray))(input));
  if (!entry.colors)
  {
    entry.colors = vtkSmartPointer<vtkPolyDataMapper>::New();
  }
  entry.colors->vtkMapper::ShallowCopy(mapper);
  // Null also where scalars would be interpolated before they are mapped, as in VTK.
  vtkUnsignedCharArray* colors = entry.colors->MapScalars(input, opacity);
  entry.beyond = places.fault();
  if (mask && mask->GetNumberOfComponents() != 1)
  {
    entry.beyond = "has a mask with more than one component";
  }
  else if (isTooShort(mask, points) || isTooShort(indices, points))
  {
    entry.beyond = "has arrays with fewer values than points";
  }
  else if (colors && (colors->GetNumberOfComponents() != 4 || isTooShort(colors, points)))
  {
    entry.beyond = "has colours that do not belong to its points";
  }
  if (entry.beyond || sources == 0)
  {
    return;
  }

  std::vector<std::shared_ptr<GlyphSet>> sets;
  for (std::size_t i = 0; i < sources; ++i)
  {
    sets.push_back(std::make_shared<GlyphSet>());
    sets.back()->source = i;
  }
  if (!indices)
  {
    sets.front()->copies.reserve(static_cast<std::size_t>(points));
  }
  const auto last = static_cast<double>(sources - 1);
  for (vtkIdType point = 0; point < points; ++point)
  {
    if (mask && mask->GetValue(point) == 0)
    {
      continue;
    }
    std::size_t source = 0;
    if (indices)
    {
      const double value =
        vtkMath::Norm(indices->GetTuple(point), indices->GetNumberOfComponents());
      source = value > 0.0 ? static_cast<std::size_t>(std::min(value, last)) : 0;
    }
    GlyphSet& set = *sets[source];
    GlyphCopy copy;
    if (!places.at(point, copy.place, set.condition))
    {
      continue;
    }
    copy.color = color;
    if (colors)
    {
      colors->GetTypedTuple(point, copy.color.data());
    }
    copy.point = point;
    set.opaque = set.opaque && copy.color[3] == 255;
    set.copies.push_back(copy);
  }
  for (const auto& set : sets)
  {
    if (!set->copies.empty())
    {
      entry.sets.push_back(set);
    }
  }
}

void add(vtkDataSet* input, const Block& block, Looking& looking)
{
  vtkGlyph3DMapper* mapper = looking.mapper;
  if (input->GetNumberOfPoints() < 1)
  {
    return;
  }
  // What was made since the last frame is later than all that was looked at then.
  const GlyphStamp stamp(std::max(mapper->GetMTime(), input->GetMTime()), looking.sources.size(),
    block.opacity, bytesOf(block.color, block.opacity));
  const PlacedGlyphs& entry = looking.copies.of({ mapper, input }, stamp, looking.kept,
    [&](PlacedGlyphs& changed) { compute(mapper, input, stamp, changed); });
  Glyphs& result = looking.result;
  for (const auto& set : entry.sets)
  {
    for (vtkPolyData* mesh : looking.sources[set->source])
    {
      result.drawn.push_back({ mesh, set, block.index, block.inTree, glm::vec3(block.color) });
    }
  }
  result.beyond = result.beyond ? result.beyond : entry.beyond;
}

/// VTK's rules about attributes of blocks: up to 9.3 those of the leaves alone count.
void visit(vtkDataObject* input, Block block, Looking& looking)
{
  auto* tree = vtkDataObjectTree::SafeDownCast(input);
  vtkCompositeDataDisplayAttributes* attributes = looking.mapper->GetBlockAttributes();
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0)
  const bool counts = attributes != nullptr;
  if (counts && attributes->HasBlockOpacity(input))
  {
    block.opacity = attributes->GetBlockOpacity(input);
  }
#else
  const bool counts = attributes && !tree;
#endif
  if (counts && attributes->HasBlockColor(input))
  {
    attributes->GetBlockColor(input, &block.color.x);
  }
  if (counts && attributes->HasBlockVisibility(input))
  {
    block.visible = attributes->GetBlockVisibility(input);
  }
  block.index = looking.flatIndex++;
  if (!tree)
  {
    auto* dataSet = vtkDataSet::SafeDownCast(input);
    if (dataSet && block.visible)
    {
      add(dataSet, block, looking);
    }
    return;
  }
  for (vtkDataObject* child : vtk::Range(tree, vtk::DataObjectTreeOptions::None))
  {
    if (child)
    {
      visit(child, block, looking);
    }
    else
    {
      ++looking.flatIndex;
    }
  }
}
}

bool isGlyphMapper(vtkMapper* mapper)
{
  return std::string(mapper->GetClassName()) == "vtkOpenGLGlyph3DMapper";
}

Glyphs glyphsOf(vtkGlyph3DMapper* mapper, vtkProperty* property, GlyphCopies& copies, Kept& kept)
{
  Looking looking{ mapper, copies, kept, {}, 0, {} };
  for (vtkDataObject* source : sourcesOf(mapper))
  {
    looking.sources.push_back(leavesOf(source));
  }
  Block block;
  property->GetColor(&block.color.x);
  block.opacity = property->GetOpacity();
  vtkDataObject* input = mapper->GetInputDataObject(0, 0);
  if (auto* dataSet = vtkDataSet::SafeDownCast(input))
  {
    add(dataSet, block, looking);
  }
  else if (input)
  {
    block.inTree = true;
    visit(input, block, looking);
  }
  if (looking.result.beyond)
  {
    looking.result.drawn.clear();
  }
  return looking.result;
}
}
