#include "svoLightDetail.h"

#include "svoCasters.h"
#include "svoConvexParts.h"
#include "svoLightView.h"
#include "svoTranslucentGroups.h"
#include "svoWorldSize.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

namespace svo
{
namespace
{
/// Pixels that a texel may look wide before anything is done about it: of maps that are fitted to
/// what is seen some has to be traced whenever the camera moves.
constexpr double WidestTexel = 4.0;
/// Pixels that it is made to look wide at most, and that it may look if so many maps do not exist.
constexpr double WantedTexel = 2.0, WidestDetail = 8.0;
/// Further maps of a light, of all its views together.
constexpr int MostDetails = 5;
/// Texels around what is seen, for filters and for rounding.
constexpr double Margin = 4.0;
/// Of the finest map along an axis, if all of it were there.
constexpr double MostTexels = 1 << 30;

/// A surface that receives, in the world.
struct Seen
{
  const Outline* outline;
  double nearest, farthest; // linear depth from the eye, between its near and far plane
};

double depthFrom(const View& view, const glm::dvec3& p)
{
  const glm::dmat4& m = view.worldToView;
  return -(m[0][2] * p.x + m[1][2] * p.y + m[2][2] * p.z + m[3][2]);
}

/// What may be seen with shadows on it, and how near it comes to the eye.
std::vector<Seen> receiversOf(const std::vector<Outline>& outlines, const View& eye)
{
  std::vector<Seen> receivers;
  for (const Outline& outline : outlines)
  {
    if (!outline.receives)
    {
      continue;
    }
    constexpr double Infinity = std::numeric_limits<double>::infinity();
    Seen seen{ &outline, Infinity, -Infinity };
    for (const glm::dvec3& corner : worldCorners(outline, 0.0))
    {
      const double depth = depthFrom(eye, corner);
      seen.nearest = std::min(seen.nearest, depth);
      seen.farthest = std::max(seen.farthest, depth);
    }
    seen.nearest = std::max(seen.nearest, eye.tNear);
    seen.farthest = std::min(seen.farthest, eye.tFar);
    if (seen.nearest <= seen.farthest && std::isfinite(seen.farthest))
    {
      receivers.push_back(seen);
    }
  }
  return receivers;
}

/// Of what the eye sees: a rectangle of a light's map, in clip space, and depths from the eye.
struct Part
{
  glm::dvec2 low{ std::numeric_limits<double>::infinity() };
  glm::dvec2 high{ -std::numeric_limits<double>::infinity() };
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = 0.0;
  double widest = 0.0; // how wide a texel of the map looks at most, pixels
  bool empty() const { return !(low.x <= high.x); }
};

/// What the eye sees of the receivers, up to a depth, in a light's view.
Part seenPart(
  const std::vector<Seen>& receivers, const View& eye, double farthest, const View& light)
{
  Part part;
  if (!(eye.tNear < farthest))
  {
    return part;
  }
  std::vector<glm::dvec3> points;
  const glm::dmat4 toClip = light.viewToClip * light.worldToView;
  const CommonPart seenByBoth(
    { pieceOf(eye, eye.tNear, farthest), pieceOf(light, light.tNear, light.tFar) });
  for (const Seen& receiver : receivers)
  {
    if (receiver.nearest < farthest)
    {
      points.clear();
      seenByBoth.add(worldCorners(*receiver.outline, 0.0), points);
      for (const glm::dvec3& p : points)
      {
        const glm::dvec4 clip = toClip * glm::dvec4(p, 1.0);
        const glm::dvec2 at = glm::clamp(glm::dvec2(clip) / clip.w, -1.0, 1.0);
        const double depth = std::max(depthFrom(eye, p), eye.tNear);
        part.low = glm::min(part.low, at);
        part.high = glm::max(part.high, at);
        part.nearest = std::min(part.nearest, depth);
        part.farthest = std::max(part.farthest, depth);
        part.widest = std::max(
          part.widest, widerWorldPixel(light, depthFrom(light, p)) / worldPixel(eye, depth));
      }
    }
  }
  return part;
}

/// Along an axis of a light's map of so many texels: how many a larger one of the same casters has,
/// and the first of those that hold what lies between `low` and `high`, clip space.
struct Stretch
{
  int size, first;
};

Stretch stretchAlong(int texels, double low, double high)
{
  // A crop goes on by steps, so that it changes now and then only when the eye moves. Larger maps
  // have 2^k times the texels, so that these lie where they are for every eye.
  const int step = std::max(texels / 16 & ~7, 8);
  const double room = texels - 2.0 * Margin - step;
  const double most = std::min(2.0 * room / std::max(high - low, 1e-9), MostTexels);
  int scale = 1;
  while (2.0 * scale * texels <= most)
  {
    scale *= 2;
  }
  const int whole = texels + (texels & ~7) * (scale - 1); // so that the last crop is of whole tiles
  const double from = 0.5 * (low + 1.0) * whole - Margin;
  const int first = static_cast<int>(std::max(std::floor(from / step), 0.0)) * step;
  return { whole, std::min(first, whole - texels) };
}

/// The finest map of a part of what a light's map shows, with as many texels.
bool finerMap(const View& light, const Part& part, View& view)
{
  const Stretch x = stretchAlong(light.width, part.low.x, part.high.x);
  const Stretch y = stretchAlong(light.height, part.low.y, part.high.y);
  const bool valid = makeView(light.worldToView, light.viewToClip, x.size, y.size, view);
  view.crop = { x.first, y.first, x.first + light.width, y.first + light.height };
  return valid;
}

struct Fineness
{
  double coarsest; // how wide a texel looks, pixels
  bool enough;     // it would be no less with more maps
};

/// Appends views of what is seen through `light`, fine ones first: so many that a texel looks no
/// wider than `widest` pixels, or a little more, where maps can be so fine and `most` further ones
/// are enough.
Fineness refine(const View& light, const Part& all, const std::vector<Seen>& receivers,
  const View& eye, double widest, int most, std::vector<View>& views)
{
  // Texels get smaller by the same factor everywhere.
  const auto scaleOf = [&](const View& view)
  { return widerWorldPixel(view, 1.0) / widerWorldPixel(light, 1.0); };
  constexpr double WorthIt = 1.0 / 1.5;
  std::vector<View> found{ light };
  double scale = 1.0;
  View view;
  if (finerMap(light, all, view) && scaleOf(view) < WorthIt)
  {
    found.front() = view; // nobody looks up anything else
    scale = scaleOf(view);
  }
  // Pixels grow with depth: what is nearer than where they are wide enough gets a map of its own;
  // of what is nearer still if no other is finer.
  double coarsest = 0.0;
  bool enough = true;
  while (all.widest * scale > 1.25 * widest)
  {
    const auto finer = [&](double reach)
    {
      const Part near = seenPart(
        receivers, eye, eye.parallel ? all.farthest : std::min(reach, all.farthest), light);
      return !near.empty() && finerMap(light, near, view) && scaleOf(view) < WorthIt * scale;
    };
    const double from = all.nearest * all.widest * scale / widest;
    double reach = from;
    bool better = finer(reach);
    while (!better && !eye.parallel && reach > all.nearest)
    {
      reach *= std::sqrt(std::sqrt(0.5));
      better = finer(reach);
    }
    if (!better)
    {
      break; // as fine as it gets
    }
    enough = static_cast<int>(found.size()) <= most;
    if (!enough)
    {
      break;
    }
    coarsest = std::max(coarsest, widest * from / reach);
    scale = scaleOf(view);
    found.push_back(view);
  }
  views.insert(views.end(), found.rbegin(), found.rend());
  return { std::max(coarsest, all.widest * scale), enough };
}
}

LightMaps mapsOfLight(const std::vector<Outline>& outlines, const Light& light, int resolution,
  const View& eye, double coarseness)
{
  const double widestTexel = coarseness * WidestTexel;
  LightMaps maps{ castersOf(outlines, light), {} };
  maps.views = fitLight(outlines, maps.casters, light, resolution);
  maps.translucentGroups = groupTranslucent(outlines, maps.views, maps.casters);
  if (eye.width < 1 || eye.height < 1 || maps.views.empty())
  {
    return maps;
  }
  const std::vector<View> fitted = maps.views;
  const std::vector<Seen> receivers = receiversOf(outlines, eye);
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -nearest;
  for (const Seen& receiver : receivers)
  {
    nearest = std::min(nearest, receiver.nearest);
    farthest = std::max(farthest, receiver.farthest);
  }
  const double pixel = worldPixel(eye, nearest);
  for (const View& view : fitted)
  {
    const double texel = widerWorldPixel(view, view.parallel ? 0.0 : view.tFar);
    maps.widest = std::max(maps.widest, texel / pixel);
  }
  if (!std::isfinite(nearest) || !(maps.widest > widestTexel))
  {
    return maps;
  }
  maps.widest = 0.0;
  std::vector<Part> parts;
  for (const View& view : fitted)
  {
    parts.push_back(seenPart(receivers, eye, farthest, view));
    maps.widest = std::max(maps.widest, parts.back().widest);
  }
  if (!(maps.widest > widestTexel))
  {
    return maps;
  }
  for (double widest = coarseness * WantedTexel;; widest *= 2.0)
  {
    maps.views.clear();
    maps.coarsest = 0.0;
    int left = MostDetails;
    bool enough = true;
    for (std::size_t i = 0; i < fitted.size(); ++i)
    {
      if (!parts[i].empty())
      {
        const std::size_t before = maps.views.size();
        const Fineness reached =
          refine(fitted[i], parts[i], receivers, eye, widest, left, maps.views);
        maps.coarsest = std::max(maps.coarsest, reached.coarsest);
        enough = enough && reached.enough;
        left -= static_cast<int>(maps.views.size() - before) - 1;
      }
    }
    if (enough || widest >= coarseness * WidestDetail)
    {
      maps.widest = maps.coarsest;
      return maps;
    }
  }
}

/// Texels of a map that casters of one group, or opaque ones, can lie in, in whole tiles.
double texelsOf(const std::vector<Outline>& outlines, const std::vector<std::uint8_t>& casters,
  std::uint8_t group, const View& map)
{
  const double whole = static_cast<double>(map.width) * map.height;
  const glm::dmat4 toClip = map.viewToClip * map.worldToView;
  std::vector<glm::dvec3> cut;
  double texels = 0.0;
  for (std::size_t i = 0; i < casters.size() && texels < whole; ++i)
  {
    if (casters[i] != group)
    {
      continue;
    }
    const std::array<glm::dvec3, 8> corners = worldCorners(outlines[i], outlines[i].voxelSize);
    const auto isBehind = [&](const glm::dvec3& corner)
    { return !((toClip * glm::dvec4(corner, 1.0)).w > 0.0); };
    cut.assign(corners.begin(), corners.end());
    if (std::any_of(cut.begin(), cut.end(), isBehind))
    {
      cut.clear();
      CommonPart({ pieceOf(map, map.tNear, map.tFar) }).add(corners, cut);
    }
    constexpr double Infinity = std::numeric_limits<double>::infinity();
    glm::dvec2 low(Infinity), high(-Infinity);
    for (const glm::dvec3& corner : cut)
    {
      const glm::dvec4 clip = toClip * glm::dvec4(corner, 1.0);
      low = glm::min(low, glm::clamp(glm::dvec2(clip) / clip.w, -1.0, 1.0));
      high = glm::max(high, glm::clamp(glm::dvec2(clip) / clip.w, -1.0, 1.0));
    }
    constexpr double Beyond = 16.0; // texels: the tiles at both ends
    if (low.x < high.x && low.y < high.y)
    {
      const glm::dvec2 size = 0.5 * (high - low) * glm::dvec2(map.width, map.height) + Beyond;
      texels += size.x * size.y;
    }
  }
  return std::min(texels, whole);
}

std::vector<LightMaps> mapsOfLights(const std::vector<Outline>& outlines,
  const std::vector<Light>& lights, const FrameSettings& settings, const View& eye)
{
  // Depth, instance and primitive of the buffer; for receivers a copy, and OpenGL's with room to
  // grow. Where casters are translucent how opaque they are as well. Tables have their share in all
  // texels, also of maps that see nothing. Maps that VTK's shaders alone look up are OpenGL's only,
  // without tiles and tables.
  const bool whole = settings.lightCode;
  const bool translucent = std::any_of(outlines.begin(), outlines.end(),
    [](const Outline& outline) { return outline.casts && outline.translucent; });
  const double bytes = whole ? (translucent ? 8.0 : 4.0) : settings.handsOutMaps() ? 22.0 : 12.0;
  const double translucentBytes = whole ? 8.0 : settings.handsOutMaps() ? 36.0 : 16.0;
  const double tableBytes = whole ? 0.0 : 0.5, emptyTableBytes = whole ? 0.0 : 0.1;
  std::vector<LightMaps> maps(lights.size());
  const double coarseness = settings.shadowCoarseness;
  assert(coarseness >= 1.0);
  const int wanted = static_cast<int>(settings.shadowResolution / coarseness);
  for (int resolution = std::max(wanted, 16);; resolution = (resolution + 1) / 2)
  {
    double most = 0.0; // if all tiles hold something
    for (std::size_t i = 0; i < lights.size(); ++i)
    {
      if (lights[i].castShadow)
      {
        maps[i] = mapsOfLight(outlines, lights[i], resolution, eye, coarseness);
        const double texels = static_cast<double>(maps[i].views.size()) * resolution * resolution;
        most += texels *
          (bytes + tableBytes + (translucentBytes + tableBytes) * maps[i].translucentGroups);
      }
    }
    const auto limit = static_cast<double>(settings.shadowMemoryLimit);
    if (most <= limit || resolution <= 16)
    {
      return maps;
    }
    double taken = 0.0;
    for (const LightMaps& light : maps)
    {
      for (const View& view : light.views)
      {
        const View map = cropped(view);
        for (int group = 0; group <= light.translucentGroups; ++group)
        {
          const double all = static_cast<double>(map.width) * map.height;
          const double texels = texelsOf(
            outlines, light.casters, static_cast<std::uint8_t>(OpaqueCasters + group), map);
          taken +=
            (whole && texels > 0.0 ? all : texels) * (group == 0 ? bytes : translucentBytes) +
            (texels > 0.0 ? tableBytes : emptyTableBytes) * all;
        }
      }
    }
    if (taken <= limit)
    {
      return maps;
    }
  }
}
}
