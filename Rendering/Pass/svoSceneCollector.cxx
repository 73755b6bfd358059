#include "svoSceneCollector.h"

#include "svoAffineMatrix.h"
#include "svoCameraView.h"
#include "svoSceneLights.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkAssembly.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositePolyDataMapper2.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeRange.h"
#include "vtkDataSetMapper.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkLookupTable.h"
#include "vtkMatrix4x4.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPropAssembly.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSVORenderPass.h"

#include <functional>
#include <iterator>

namespace svo
{
/// What one frame's collection hands around.
struct SceneCollector::Frame
{
  const StoreOptions& options;
  CollectSettings settings;
  CollectedScene& result;
  std::vector<PropSurfaces> props;
};

namespace
{
std::uint64_t combine(std::uint64_t a, std::uint64_t b)
{
  return a ^ (b + 0x9e3779b97f4a7c15ull + (a << 6) + (a >> 2));
}

/// An explicit answer of the part or of the assembly that it belongs to; `otherwise` without one.
bool flagOf(vtkProp* prop, vtkProp* owner, vtkInformationIntegerKey* key, bool otherwise)
{
  for (vtkProp* asked : { prop, owner })
  {
    vtkInformation* keys = asked->GetPropertyKeys();
    if (keys && keys->Has(key))
    {
      return keys->Get(key) != 0;
    }
  }
  return otherwise;
}

double pixelErrorOf(vtkProp* prop, vtkProp* owner)
{
  const double own = vtkSVORenderPass::GetPropPixelError(prop);
  return own >= 0.0 ? own : vtkSVORenderPass::GetPropPixelError(owner);
}

/// True if the prop or its assembly says explicitly that it uses octrees.
bool isMarked(vtkProp* prop, vtkProp* owner)
{
  return flagOf(prop, owner, vtkSVORenderPass::USE_SVO(), false);
}

bool hasSurface(vtkPolyData* mesh)
{
  return mesh->GetNumberOfPolys() > 0 || mesh->GetNumberOfStrips() > 0;
}

/// What the composite mapper's attributes say on the way down to a block.
struct BlockState
{
  bool visible = true;
  bool overridesColor = false;
  glm::vec3 color{ 1.0f };
  double opacity = 1.0;
};

using BlockVisitor = std::function<void(vtkPolyData*, unsigned int, const BlockState&)>;

void visitBlocks(vtkDataObject* object, vtkCompositeDataDisplayAttributes* attributes,
  BlockState state, unsigned int& flatIndex, const BlockVisitor& visit)
{
  if (attributes && attributes->HasBlockVisibility(object))
  {
    state.visible = attributes->GetBlockVisibility(object);
  }
  if (attributes && attributes->HasBlockOpacity(object))
  {
    state.opacity = attributes->GetBlockOpacity(object);
  }
  if (attributes && attributes->HasBlockColor(object))
  {
    const vtkColor3d color = attributes->GetBlockColor(object);
    state.overridesColor = true;
    state.color = { color[0], color[1], color[2] };
  }
  const unsigned int index = flatIndex++;
  if (auto* tree = vtkDataObjectTree::SafeDownCast(object))
  {
    for (vtkDataObject* child : vtk::Range(tree, vtk::DataObjectTreeOptions::None))
    {
      if (child)
      {
        visitBlocks(child, attributes, state, flatIndex, visit);
      }
      else
      {
        ++flatIndex;
      }
    }
  }
  else if (auto* mesh = vtkPolyData::SafeDownCast(object))
  {
    if (state.visible)
    {
      visit(mesh, index, state);
    }
  }
}

/// Blocks that lack the array the others are coloured by take the table's colour of NaN, if asked.
void colorMissingArray(vtkCompositePolyDataMapper2* mapper, SurfacePart& part)
{
  if (!mapper->GetColorMissingArraysWithNanColor() || !mapper->GetScalarVisibility())
  {
    return;
  }
  int cells = 0;
  auto* table = vtkLookupTable::SafeDownCast(mapper->GetLookupTable());
  if (table &&
    !vtkAbstractMapper::GetAbstractScalars(part.mesh, mapper->GetScalarMode(),
      mapper->GetArrayAccessMode(), mapper->GetArrayId(), mapper->GetArrayName(), cells))
  {
    const double* nan = table->GetNanColor();
    part.overridesColor = true;
    part.color = { nan[0], nan[1], nan[2] };
  }
}
}

void SceneCollector::complainOnce(const void* about, const std::string& text, const Frame& frame)
{
  if (this->Said.emplace(about, text).second)
  {
    frame.options.complain(text);
  }
}

vtkMapper* SceneCollector::colorsOfBlock(vtkMapper* mapper, vtkPolyData* block)
{
  BlockColors& colors = this->Blocks[{ mapper, block }];
  colors.lastFrame = this->FrameNumber;
  if (!colors.mapper)
  {
    colors.mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  }
  if (colors.time != mapper->GetMTime())
  {
    colors.time = mapper->GetMTime();
    colors.mapper->vtkMapper::ShallowCopy(mapper);
    colors.mapper->SetInputData(block);
  }
  return colors.mapper;
}

std::vector<SurfacePart> SceneCollector::partsOf(vtkActor* actor)
{
  std::vector<SurfacePart> parts;
  vtkMapper* mapper = actor->GetMapper();
  SurfacePart whole;
  whole.opacity = actor->GetProperty()->GetOpacity();
  if (auto* composite = vtkCompositePolyDataMapper2::SafeDownCast(mapper))
  {
    vtkDataObject* root = composite->GetInputDataObject(0, 0);
    BlockState state;
    state.opacity = whole.opacity;
    unsigned int flatIndex = 0;
    visitBlocks(root, composite->GetCompositeDataDisplayAttributes(), state, flatIndex,
      [&](vtkPolyData* mesh, unsigned int index, const BlockState& block)
      {
        SurfacePart part;
        part.mesh = mesh;
        part.colors = this->colorsOfBlock(mapper, mesh);
        part.block = index;
        part.overridesColor = block.overridesColor;
        part.color = block.color;
        part.opacity = block.opacity;
        colorMissingArray(composite, part);
        parts.push_back(part);
      });
  }
  else
  {
    auto* dataSet = vtkDataSetMapper::SafeDownCast(mapper);
    vtkPolyDataMapper* plain =
      dataSet ? this->Surfaces.mapperOf(dataSet) : vtkPolyDataMapper::SafeDownCast(mapper);
    if (plain && plain->GetInput())
    {
      whole.mesh = plain->GetInput();
      whole.colors = plain;
      parts.push_back(whole);
    }
  }
  return parts;
}

/// Adds the actor's surfaces. False if the rasteriser has to draw the actor.
bool SceneCollector::collectActor(vtkActor* actor, vtkProp* owner, const vtkMatrix4x4* matrix,
  int path, std::vector<SceneSurface>& surfaces, Frame& frame)
{
  if (!isPlainActor(actor) && !isMarked(actor, owner))
  {
    return false; // it may well draw without a mapper of its own
  }
  vtkMapper* mapper = actor->GetMapper();
  if (!mapper || mapper->GetNumberOfInputConnections(0) == 0)
  {
    return true;
  }
  if (frame.settings.onlyMarked && !isMarked(actor, owner))
  {
    return false;
  }
  if (!mapper->GetStatic())
  {
    mapper->GetInputAlgorithm()->Update();
  }
  Treatment treatment = treatmentOf(actor);
  const glm::dmat4 localToWorld = toGlm(matrix);
  if (treatment != Treatment::Rasterize)
  {
    switch (kindOf(localToWorld))
    {
      case MatrixKind::Singular:
        this->complainOnce(
          actor, "An actor is not drawn: its matrix is singular, nearly so, or not finite.", frame);
        return true;
      case MatrixKind::Projective:
        this->complainOnce(actor,
          "An actor casts no shadow and is left to the rasteriser: its matrix is not affine.",
          frame);
        treatment = Treatment::Rasterize;
        break;
      case MatrixKind::Affine:
        break;
    }
  }
  if (treatment == Treatment::Rasterize)
  {
    return false;
  }

  vtkProperty* property = actor->GetProperty();
  const bool composite = mapper->IsA("vtkCompositePolyDataMapper2");
  const bool translucent = actor->HasTranslucentPolygonalGeometry();
  const bool mayTrace =
    treatment == Treatment::Trace && flagOf(actor, owner, vtkSVORenderPass::USE_SVO(), true);
  bool traced = mayTrace;
  for (const SurfacePart& part : this->partsOf(actor))
  {
    if (!hasSurface(part.mesh))
    {
      traced = traced && part.mesh->GetNumberOfCells() == 0;
      continue;
    }
    SceneSurface surface;
    surface.mesh = part.mesh;
    Instance& instance = surface.instance;
    surface.traceable = mayTrace &&
      lookOf(part, property, !frame.result.scene.lights.empty(), instance.material,
        instance.attributes, this->Floats, frame.result.kept);
    surface.casts = flagOf(actor, owner, vtkSVORenderPass::CAST_SHADOW(),
      part.opacity >= 1.0 && (composite || !translucent));
    surface.casts = surface.casts && frame.settings.shadows;
    traced = traced && surface.traceable;
    if (!surface.traceable && !surface.casts)
    {
      continue;
    }
    instance.localToWorld = localToWorld;
    instance.pixelError = pixelErrorOf(actor, owner);
    instance.receiveShadow = flagOf(actor, owner, vtkSVORenderPass::RECEIVE_SHADOW(), true);
    instance.id =
      combine(combine(reinterpret_cast<std::uintptr_t>(actor), part.block), std::uint64_t(path));
    instance.depthOffsetUnits = static_cast<float>(coincidentDepthOffset(mapper));
    surfaces.push_back(surface);
  }
  return traced;
}

void SceneCollector::collectProp(vtkProp* prop, Frame& frame)
{
  PropSurfaces found;
  found.prop = prop;
  const auto collect = [&](vtkActor* actor, const vtkMatrix4x4* matrix)
  {
    found.traced =
      this->collectActor(actor, prop, matrix, found.actors, found.surfaces, frame) && found.traced;
    found.receives = found.receives ||
      (actor->GetMapper() && actor->GetProperty()->GetLighting() &&
        flagOf(actor, prop, vtkSVORenderPass::RECEIVE_SHADOW(), true));
    ++found.actors;
  };

  if (auto* actor = vtkActor::SafeDownCast(prop))
  {
    collect(actor, actor->GetMatrix());
  }
  else if (vtkAssembly::SafeDownCast(prop) || vtkPropAssembly::SafeDownCast(prop))
  {
    prop->InitPathTraversal();
    while (vtkAssemblyPath* path = prop->GetNextPath())
    {
      vtkProp* leaf = path->GetLastNode()->GetViewProp();
      if (!leaf->GetVisibility())
      {
        continue;
      }
      if (auto* part = vtkActor::SafeDownCast(leaf))
      {
        collect(part, path->GetLastNode()->GetMatrix());
      }
      else if (leaf != prop)
      {
        found.traced = false;
      }
    }
  }
  else
  {
    return;
  }

  frame.props.push_back(std::move(found));
}

namespace
{
/// Adds a prop, whose surfaces have their octrees, to the scene.
void addProp(const PropSurfaces& prop, CollectedScene& result)
{
  if (prop.traced)
  {
    result.replaced.insert(prop.prop);
    result.tracedActors += prop.surfaces.empty() ? 0 : prop.actors;
  }
  else
  {
    result.rasterizedActors += prop.actors;
    result.rasterizedReceivers = result.rasterizedReceivers || prop.receives;
    addReceiver(prop, result.scene);
  }
  for (const SceneSurface& surface : prop.surfaces)
  {
    if (surface.instance.octree && (prop.traced || surface.casts))
    {
      result.scene.instances.push_back(surface.instance);
      result.scene.instances.back().visible = prop.traced;
      result.meshes.push_back(surface.mesh);
    }
  }
}
}

void SceneCollector::collect(vtkRenderer* renderer, OctreeStore& store, const StoreOptions& options,
  const CollectSettings& settings, CollectedScene& result)
{
  ++this->FrameNumber;
  result.scene.lights = lightsOf(renderer, result.headlightOnly);
  bool casting = false;
  for (const Light& light : result.scene.lights)
  {
    casting = casting || light.castShadow;
  }
  Frame frame{ options, settings, result, {} };
  frame.settings.shadows = settings.shadows && casting;
  vtkCollectionSimpleIterator iterator;
  vtkPropCollection* props = renderer->GetViewProps();
  props->InitTraversal(iterator);
  while (vtkProp* prop = props->GetNextProp(iterator))
  {
    if (prop->GetVisibility())
    {
      this->collectProp(prop, frame);
    }
  }
  findOctrees(frame.props, result.scene.lights, settings.levels, store, options);
  for (const PropSurfaces& prop : frame.props)
  {
    addProp(prop, result);
  }
  this->Surfaces.endFrame();
  this->Floats.endFrame();
  for (auto block = this->Blocks.begin(); block != this->Blocks.end();)
  {
    block =
      block->second.lastFrame == this->FrameNumber ? std::next(block) : this->Blocks.erase(block);
  }
}
}
