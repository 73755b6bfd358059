#include "svoSceneCollector.h"

#include "svoBox.h"
#include "svoCameraView.h"
#include "svoCoincidentOrder.h"
#include "svoPropKeys.h"
#include "svoRoundSurfaces.h"
#include "svoSceneInstances.h"
#include "svoSharedMappers.h"

#include "vtkActor.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <tuple>
#include <unordered_map>

namespace svo
{
namespace
{
bool sameLights(const std::vector<Light>& a, const std::vector<Light>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](const Light& x, const Light& y) { return valuesOf(x) == valuesOf(y); });
}

/// True if both ask for the same octrees.
bool sameLevels(const LevelSettings& a, const LevelSettings& b)
{
  const auto values = [](const LevelSettings& s)
  {
    const FrameSettings& f = s.frame;
    return std::tie(s.tracer, s.eye.width, s.eye.height, s.eye.worldToView, s.eye.viewToClip,
      f.shadowTechnique, f.shadowResolution, f.shadowCoarseness, f.shadowMemoryLimit,
      f.automaticBias, f.bias, f.pixelError, f.antiAliasing, f.filterShadows);
  };
  return values(a) == values(b);
}

/// True if a length looks as many pixels wide to both.
bool sameWidths(const View& a, const View& b)
{
  return std::tie(a.width, a.worldToView, a.viewToClip) ==
    std::tie(b.width, b.worldToView, b.viewToClip);
}

bool sameStore(const StoreOptions& a, const StoreOptions& b)
{
  return std::tie(a.convert, a.level, a.leafGeometry, a.wait) ==
    std::tie(b.convert, b.level, b.leafGeometry, b.wait);
}

/// What a prop without surfaces says to a frame is the same.
bool saysTheSame(const PropSurfaces& a, const PropSurfaces& b)
{
  const auto text = [](Reason reason) { return std::string_view(reason ? reason : ""); };
  return a.surfaces.empty() && b.surfaces.empty() && a.bounds == b.bounds &&
    a.mappers == b.mappers &&
    std::tie(a.traced, a.receives, a.reaches, a.actors, a.catchesShadows, a.planes) ==
    std::tie(b.traced, b.receives, b.reaches, b.actors, b.catchesShadows, b.planes) &&
    text(a.rasterized) == text(b.rasterized) && text(a.castsNone) == text(b.castsNone);
}

void noteBounds(PropSurfaces& prop)
{
  prop.bounds = prop.boundsOfMapper = PropSurfaces().bounds;
  if (!prop.traced || prop.surfaces.empty())
  {
    const double* bounds = prop.prop->GetBounds();
    std::copy_n(bounds, bounds ? 6 : 0, prop.bounds.begin());
    auto* actor = vtkActor::SafeDownCast(prop.prop);
    if (bounds && actor && actor->GetMapper())
    {
      std::copy_n(actor->GetMapper()->GetBounds(), 6, prop.boundsOfMapper.begin());
    }
  }
}

/// The same of an actor that has moved. To ask it has VTK go through its pipeline.
void moveBounds(PropSurfaces& prop)
{
  const std::array<double, 6>& b = prop.boundsOfMapper;
  if (b[0] <= b[1])
  {
    const Box box = boxAround(b.data(), toGlm(vtkActor::SafeDownCast(prop.prop)->GetMatrix()));
    prop.bounds = { box.low.x, box.high.x, box.low.y, box.high.y, box.low.z, box.high.z };
  }
  else if (prop.bounds[0] <= prop.bounds[1])
  {
    noteBounds(prop);
  }
}

constexpr Reason NoActor = "is neither an actor nor an assembly";

/// Why octrees are missing.
Reason withoutOctree(const StoreOptions& options)
{
  return options.convert ? "has no octree, or none yet" : "comes without an octree";
}
}

std::vector<vtkSmartPointer<vtkProp>> propsOf(vtkRenderer* renderer)
{
  std::vector<vtkSmartPointer<vtkProp>> props;
  vtkCollectionSimpleIterator iterator;
  vtkPropCollection* collection = renderer->GetViewProps();
  props.reserve(static_cast<std::size_t>(collection->GetNumberOfItems()));
  collection->InitTraversal(iterator);
  while (vtkProp* prop = collection->GetNextProp(iterator))
  {
    props.emplace_back(prop);
  }
  return props;
}

PropSurfaces SceneCollector::judge(vtkProp* prop)
{
  CollectProps frame;
  frame.translucentShadows = true;
  PropSurfaces found;
  found.prop = prop;
  if (!prop->GetVisibility())
  {
    found.castNothing("is not visible");
  }
  else if (canCollect(prop))
  {
    this->Props.collect(found, frame);
  }
  else
  {
    found.leaveAlone(NoActor);
  }
  return found;
}

/// Collects the props that have changed. True if that is any, or if some are gone.
bool SceneCollector::collectProps(
  const std::vector<vtkSmartPointer<vtkProp>>& props, const CollectProps& frame, bool all)
{
  bool changed = all;
  this->Anew = this->Others = 0;
  bool reordered = false;
  std::unordered_map<vtkProp*, PropSurfaces> others; // of the last frame, from where that differs
  std::size_t place = 0;
  vtkAlgorithm* updated = nullptr;
  for (vtkProp* prop : props)
  {
    if (!prop->GetVisibility())
    {
      continue;
    }
    if (place == this->Found.size() || this->Found[place].prop != prop)
    {
      if (!canCollect(prop))
      {
        this->Others += vtkProp3D::SafeDownCast(prop) != nullptr;
        continue;
      }
      if (!reordered)
      {
        reordered = changed = true;
        for (std::size_t i = place; i < this->Found.size(); ++i)
        {
          vtkProp* former = this->Found[i].prop;
          others.emplace(former, std::move(this->Found[i]));
        }
        this->Found.resize(place);
      }
      const auto other = others.find(prop);
      this->Found.push_back(other != others.end() ? std::move(other->second) : PropSurfaces());
    }
    PropSurfaces& known = this->Found[place++];
    if (!all && known.prop && known.kept.inPlace())
    {
      const Held held = known.state.holds(prop, updated);
      if (held == Held::Yes)
      {
        continue;
      }
      if (held == Held::Moved && PropCollector::move(known, frame))
      {
        known.state.noteMove(prop);
        moveBounds(known);
        changed = true;
        continue;
      }
    }
    ++this->Anew;
    PropSurfaces found;
    found.prop = prop;
    this->Props.collect(found, frame);
    found.state.note(prop);
    noteBounds(found);
    changed = changed || !known.prop || !saysTheSame(known, found);
    known = std::move(found);
  }
  changed = changed || place < this->Found.size();
  this->Found.resize(place);
  others.clear();
  if (changed || this->Anew > 0)
  {
    this->Props.sweep();
  }
  return changed;
}

/// Makes the scene of what was found.
void SceneCollector::assemble(CollectedScene& result)
{
  result.meshes.clear();
  result.props.clear();
  result.scene.receivers.clear();
  result.replaced.clear();
  result.receivers.clear();
  result.tracedActors = result.rasterizedActors = 0;
  result.rasterizedReceivers = result.receiversReach = result.shadowCatchers = false;
  result.planes = result.marked = false;
  const bool changed = writeInstances(this->Found, Stage::Shown, this->Instances);
  bool complete = true;
  for (const PropSurfaces& prop : this->Found)
  {
    result.planes = result.planes || prop.planes;
    result.marked = result.marked || prop.marked || this->Choices.unmarkedToo;
    if (prop.shown)
    {
      result.replaced.insert(prop.prop);
      result.tracedActors += prop.surfaces.empty() ? 0 : prop.actors;
    }
    else
    {
      result.rasterizedActors += prop.actors;
    }
    if (!prop.shown || this->Choices.openGL)
    {
      result.rasterizedReceivers = result.rasterizedReceivers || prop.receives;
      result.receiversReach = result.receiversReach || (prop.receives && prop.reaches);
      result.shadowCatchers = result.shadowCatchers || prop.catchesShadows;
      if (prop.receives || prop.catchesShadows)
      {
        result.receivers.insert(prop.prop);
      }
      addReceiver(prop, prop.shown, result.scene);
    }
    for (const SceneSurface& surface : prop.surfaces)
    {
      const bool used = surface.instance.body->octree && (prop.shown || surface.casts);
      complete = complete && used;
      if (used)
      {
        result.meshes.resize(result.meshes.size() + surface.count(), surface.mesh);
        result.props.resize(result.meshes.size(), prop.prop);
      }
    }
  }
  if (changed || result.own != result.meshes.size())
  {
    this->Version = newVersion();
  }
  result.scene.version = this->Version;
  result.own = result.meshes.size();
  this->Lent = complete;
  if (complete)
  {
    result.scene.instances.swap(this->Instances);
    return;
  }
  result.scene.instances.clear();
  for (const PropSurfaces& prop : this->Found)
  {
    for (const SceneSurface& surface : prop.surfaces)
    {
      if (surface.instance.body->octree && (prop.shown || surface.casts))
      {
        const auto first = this->Instances.begin() + surface.written.place;
        result.scene.instances.insert(result.scene.instances.end(), first, first + surface.count());
      }
    }
  }
}

/// Tells why props are not what they were chosen to be.
void SceneCollector::explain(
  const CollectSettings& settings, const StoreOptions& options, CollectedScene& result) const
{
  result.reasons.clear();
  if (!settings.onlyMarked)
  {
    return;
  }
  for (const PropSurfaces& prop : this->Found)
  {
    const bool casts = std::any_of(prop.surfaces.begin(), prop.surfaces.end(),
      [](const SceneSurface& surface) { return surface.casts && surface.instance.body->octree; });
    const Reason missing = prop.hasOctrees() ? nullptr : withoutOctree(options);
    const Reason left = missing ? missing : reasonOfSharing(prop);
    const Reason own = prop.rasterized == IsDrawnByOpenGL ? nullptr : prop.rasterized;
    const Reason rasterized = own ? own : left;
    const Reason castsNone = prop.castsNone ? prop.castsNone : missing;
    const bool asChosen = !castsNone && !prop.marked;
    const std::string text = reasons(rasterized, castsNone, casts);
    if (!asChosen && !text.empty())
    {
      result.reasons.emplace_back(prop.prop, text);
    }
  }
}

/// Says why no shadow can be seen, if that is so.
void SceneCollector::missShadows(const StoreOptions& options, CollectedScene& result) const
{
  result.nothingCasts.clear();
  result.nothingReceives.clear();
  result.clippedCastNone = this->Choices.shadows &&
    std::any_of(this->Found.begin(), this->Found.end(),
      [](const PropSurfaces& prop)
      {
        return prop.castsNone == HasClippingPlanes &&
          flagOf(prop.prop, nullptr, castShadowKey(), true);
      });
  int casters = 0, receivers = 0; // that could be, and are none
  bool casts = !this->Choices.shadows, receives = casts;
  std::set<std::string_view> reasons;
  for (const PropSurfaces& prop : this->Found)
  {
    const bool ready = options.convert || prop.hasOctrees(); // or will be
    casts = casts || (prop.casts() && ready);
    receives = receives || prop.receives;
    if (casts && receives)
    {
      return;
    }
    const Reason reason = prop.castsNone ? prop.castsNone
      : ready                            ? nullptr
                                         : withoutOctree(options);
    // Hosts' views have outlines, axes and the like as well, and a switch for translucent shadows.
    const bool meant = this->Choices.onlyMarked &&
      (prop.catchesShadows || reason == this->NotMarked.c_str() || reason == ShowsNoPolygons ||
        reason == HasNoPolygons || reason == MayDrawAnything ||
        (reason == IsTranslucent && !this->Choices.translucentShadows));
    if (reason && !meant && flagOf(prop.prop, nullptr, castShadowKey(), true))
    {
      ++casters;
      reasons.insert(reason);
    }
    const bool shows = prop.rasterized || !prop.surfaces.empty();
    receivers += shows && !meant && flagOf(prop.prop, nullptr, receiveShadowKey(), true);
  }
  if (this->Others > 0 && !this->Choices.onlyMarked)
  {
    casters += this->Others;
    reasons.insert(NoActor);
  }
  if (!casts && casters > 0)
  {
    result.withoutShadows = casters;
    for (std::string_view reason : reasons)
    {
      result.nothingCasts.append(result.nothingCasts.empty() ? "" : ", or ").append(reason);
    }
  }
  else if (casts && receivers > 0)
  {
    result.withoutShadows = receivers;
    result.nothingReceives =
      "looks the same in every light: lighting is off, or nothing is diffuse or specular";
  }
}

void SceneCollector::collect(vtkRenderer* renderer, OctreeStore& store, const StoreOptions& options,
  const CollectSettings& settings, CollectedScene& result)
{
  result.current = false;
  const glm::dmat4 world = sceneTransform(renderer);
  std::vector<Light> lights = lightsOf(renderer, world, settings.lightWords, result.lights);
  const bool otherLights = !sameLights(lights, result.scene.lights);
  result.scene.lights = std::move(lights);
  bool casting = false;
  for (const Light& light : result.scene.lights)
  {
    casting = casting || light.castShadow;
  }
  const bool sameReason = this->NotMarked == settings.notMarked;
  if (!sameReason)
  {
    this->NotMarked = settings.notMarked;
  }
  CollectProps frame = static_cast<const CollectProps&>(settings);
  frame.shadows = (settings.shadows && casting) || settings.levels.frame.asksHemispheres();
  frame.lights = !result.scene.lights.empty() || settings.levels.frame.asksHemispheres();
  frame.world = world;
  frame.notMarked = this->NotMarked.c_str();
  frame.complain = options.complain;
  frame.eye = settings.levels.eye.width > 0 ? &settings.levels.eye : nullptr;
  const std::vector<vtkSmartPointer<vtkProp>> props = propsOf(renderer);
  const bool all = !this->Collected || !sameReason || this->Choices.values() != frame.values();
  this->Collected = true;
  this->Choices = static_cast<const PropChoices&>(frame);
  const bool changed = this->collectProps(props, frame, all);
  if (changed)
  {
    const auto places = [](const PropSurfaces& prop)
    {
      return std::any_of(prop.surfaces.begin(), prop.surfaces.end(),
        [](const SceneSurface& surface) { return surface.placed != nullptr; });
    };
    this->Placed = std::any_of(this->Found.begin(), this->Found.end(), places);
  }
  const View& eye = settings.levels.eye;
  if (this->Placed)
  {
    placeRoundShapes(this->Found, eye, sameWidths(eye, this->Levels.eye));
  }

  if (this->Lent)
  {
    result.scene.instances.resize(result.own); // without those of other processes
    result.scene.version = this->Version;
  }
  const bool sameOptions = sameStore(options, this->Options);
  const bool same = !changed && !otherLights && this->Complete &&
    sameLevels(settings.levels, this->Levels) && sameOptions &&
    store.version() == this->StoreVersion && store.building() == 0;
  if (same && this->Lent)
  {
    result.current = true;
    return;
  }
  if (this->Lent)
  {
    this->Instances.swap(result.scene.instances);
    this->Lent = false;
  }
  findOctrees(this->Found, result.scene.lights, settings.levels, store, options, sameOptions,
    this->Instances);
  leaveShared(this->Found);
  orderCoincident(this->Found);
  this->assemble(result);
  this->explain(settings, options, result);
  this->missShadows(options, result);
  result.current = true;
  this->Levels = settings.levels;
  this->Options.convert = options.convert;
  this->Options.level = options.level;
  this->Options.leafGeometry = options.leafGeometry;
  this->Options.wait = options.wait;
  this->StoreVersion = store.version();
  this->Complete = std::all_of(this->Found.begin(), this->Found.end(),
    [](const PropSurfaces& prop) { return prop.hasOctrees(); });
}

void SceneCollector::forget()
{
  this->Collected = false;
  this->Lent = false;
  this->Found.clear();
  this->Instances = std::vector<Instance>();
  this->Props.sweep();
}
}
