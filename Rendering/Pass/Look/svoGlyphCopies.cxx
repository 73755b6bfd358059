#include "svoGlyphCopies.h"

#include "svoMeshOctree.h"

#include "vtkBitArray.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeRange.h"
#include "vtkDataSet.h"
#include "vtkGlyph3DMapper.h"
#include "vtkMath.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkQuaternion.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVersion.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace svo
{
namespace
{
/// The mapper tells its subclasses only which arrays it reads.
struct Asking : public vtkGlyph3DMapper
{
  using vtkGlyph3DMapper::GetMaskArray;
  using vtkGlyph3DMapper::GetOrientationArray;
  using vtkGlyph3DMapper::GetScaleArray;
  using vtkGlyph3DMapper::GetSourceIndexArray;
};

/// True of an array that has no value for some of the points.
bool isTooShort(vtkAbstractArray* array, vtkIdType points)
{
  return array && array->GetNumberOfTuples() < points;
}

/// Where the mapper puts copies, by its settings and an input's arrays.
class GlyphPlaces
{
public:
  GlyphPlaces(vtkGlyph3DMapper* mapper, vtkDataSet* input)
    : Input(input)
    , Scales((mapper->*(&Asking::GetScaleArray))(input))
    , Orientations((mapper->*(&Asking::GetOrientationArray))(input))
    , ScaleMode(mapper->GetScaleMode())
    , OrientationMode(mapper->GetOrientationMode())
    , Scaling(mapper->GetScaling())
    , Clamping(mapper->GetClamping() && this->ScaleMode != vtkGlyph3DMapper::NO_DATA_SCALING)
    , Factor(mapper->GetScaleFactor())
    , Low(mapper->GetRange()[0])
    , High(mapper->GetRange()[1])
  {
  }

  /// Why the mapper draws nothing, or nothing certain; null if all is well.
  Reason fault() const
  {
    const int components = this->Orientations ? this->Orientations->GetNumberOfComponents() : 0;
    const int wanted = this->OrientationMode == vtkGlyph3DMapper::QUATERNION ? 4 : 3;
    if (this->Orientations && components != wanted)
    {
      return "has orientations with the wrong number of components";
    }
    const vtkIdType points = this->Input->GetNumberOfPoints();
    return isTooShort(this->Orientations, points) || isTooShort(this->Scales, points)
      ? "has arrays with fewer values than points"
      : nullptr;
  }

  /// The copy at a point: source -> input. False if it cannot be seen: nowhere, or a point itself.
  /// `condition` is raised to that of the matrix, in the Frobenius norm.
  bool at(vtkIdType point, glm::dmat4x3& place, double& condition) const
  {
    glm::dmat3 turn(1.0);
    if (this->Orientations)
    {
      double matrix[3][3];
      this->turnOf(point).ToMatrix3x3(matrix);
      for (int i = 0; i < 9; ++i)
      {
        turn[i % 3][i / 3] = matrix[i / 3][i % 3];
      }
    }
    const glm::dvec3 scale = this->Scaling ? this->scaleOf(point) : glm::dvec3(1.0);
    place = glm::dmat4x3(turn[0] * scale.x, turn[1] * scale.y, turn[2] * scale.z,
      glm::make_vec3(this->Input->GetPoint(point)));
    double sum = 0.0;
    for (int i = 0; i < 12; ++i)
    {
      sum += std::abs(place[i / 3][i % 3]);
    }
    if (!std::isfinite(sum) || turn[0] == glm::dvec3(0.0))
    {
      return false; // a quaternion of zeros makes a matrix of zeros
    }
    // In the Frobenius norm; a turn has none.
    condition = std::max(condition, glm::length(scale) * glm::length(1.0 / scale));
    return true;
  }

private:
  vtkQuaterniond turnOf(vtkIdType point) const
  {
    double o[4] = { 0.0, 0.0, 0.0, 0.0 };
    this->Orientations->GetTuple(point, o);
    switch (this->OrientationMode)
    {
      case vtkGlyph3DMapper::ROTATION:
      {
        const auto about = [](int axis, double degrees)
        {
          const double half = 0.5 * vtkMath::RadiansFromDegrees(degrees);
          vtkQuaterniond turn(std::cos(half), 0.0, 0.0, 0.0);
          turn[axis] = std::sin(half);
          return turn;
        };
        return about(3, o[2]) * about(1, o[0]) * about(2, o[1]);
      }
      case vtkGlyph3DMapper::QUATERNION:
        return vtkQuaterniond(o);
      default:
        break;
    }
    if (o[1] == 0.0 && o[2] == 0.0)
    {
      return o[0] < 0.0 ? vtkQuaterniond(0.0, 0.0, 1.0, 0.0) : vtkQuaterniond();
    }
    // Half a turn about what is halfway between the x axis and the direction.
    const glm::dvec3 direction(o[0], o[1], o[2]);
    const glm::dvec3 axis =
      glm::normalize(0.5 * (direction + glm::dvec3(glm::length(direction), 0.0, 0.0)));
    return vtkQuaterniond(0.0, axis.x, axis.y, axis.z);
  }

  glm::dvec3 scaleOf(vtkIdType point) const
  {
    glm::dvec3 scale(1.0);
    if (this->Scales)
    {
      const int components = this->Scales->GetNumberOfComponents();
      if (this->ScaleMode == vtkGlyph3DMapper::SCALE_BY_MAGNITUDE)
      {
        scale = glm::dvec3(vtkMath::Norm(this->Scales->GetTuple(point), components));
      }
      else if (this->ScaleMode == vtkGlyph3DMapper::SCALE_BY_COMPONENTS && components == 3)
      {
        this->Scales->GetTuple(point, &scale.x);
      }
      if (this->Clamping)
      {
        const double length = this->High - this->Low;
        for (int i = 0; i < 3; ++i)
        {
          const double clamped = scale[i] < this->Low ? this->Low
            : scale[i] > this->High                   ? this->High
                                                      : scale[i];
          scale[i] = (clamped - this->Low) / (length == 0.0 ? 1.0 : length);
        }
      }
    }
    scale *= this->Factor;
    for (int i = 0; i < 3; ++i)
    {
      scale[i] = scale[i] == 0.0 ? 1e-10 : scale[i]; // so the mapper does
    }
    return scale;
  }

  vtkDataSet* Input;
  vtkDataArray* Scales;
  vtkDataArray* Orientations;
  int ScaleMode, OrientationMode;
  bool Scaling, Clamping;
  double Factor, Low, High;
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
  KeepAlive& kept;
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

bool copiesPlanes(vtkGlyph3DMapper* mapper)
{
  std::vector<vtkPolyData*> copied;
  for (vtkDataObject* source : sourcesOf(mapper))
  {
    const std::vector<vtkPolyData*> leaves = leavesOf(source);
    copied.insert(copied.end(), leaves.begin(), leaves.end());
  }
  return !copied.empty() && std::all_of(copied.begin(), copied.end(), carriesPlanes);
}

Glyphs glyphsOf(
  vtkGlyph3DMapper* mapper, vtkProperty* property, GlyphCopies& copies, KeepAlive& kept)
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
