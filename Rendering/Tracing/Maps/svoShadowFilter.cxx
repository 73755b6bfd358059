// The filtered test of a shadow buffer: which share of the light a point misses.
#include "svoShadowFilter.h"

#include "svoShadowBuffer.h"
#include "svoShadowRules.h"
#include "svoTileShadows.h"

#include <algorithm>
#include <cmath>

namespace svo
{
double ShadowBuffer::boxWidth(const Place& place, double extent)
{
  const double pixel = place.face->edge(place.t);
  return extent > pixel ? std::min(extent / pixel, WidestBox) : 1.0;
}

bool ShadowBuffer::isFlat(const Place& place, double width) const
{
  const Face& face = *place.face;
  const DepthBuffer& depth = face.layers.hits().depth;
  const TexelWindow x(place.x, width, face.view.width);
  const TexelWindow y(place.y, width, face.view.height);
  double t[TexelWindow::Most][TexelWindow::Most];
  int hits = 0;
  for (int j = 0; j < y.count; ++j)
  {
    for (int i = 0; i < x.count; ++i)
    {
      std::uint32_t caster;
      hits += face.occluder(depth.at(x.first + i, y.first + j), caster, t[j][i]);
    }
  }
  if (hits < x.count * y.count)
  {
    return hits == 0;
  }
  // A second difference of more than a texel's edge is a step or a crease.
  const double most = face.edge(place.t);
  for (int j = 0; j < y.count; ++j)
  {
    for (int i = 2; i < x.count; ++i)
    {
      if (std::abs(t[j][i - 2] - 2.0 * t[j][i - 1] + t[j][i]) > most)
      {
        return false;
      }
    }
  }
  for (int j = 2; j < y.count; ++j)
  {
    for (int i = 0; i < x.count; ++i)
    {
      if (std::abs(t[j - 2][i] - 2.0 * t[j - 1][i] + t[j][i]) > most)
      {
        return false;
      }
    }
  }
  return true;
}

bool ShadowBuffer::endsBefore(const Place& place, const glm::ivec2& texel, double error) const
{
  const Face& face = *place.face;
  const DepthBuffer& depth = face.layers.hits().depth;
  const double offset[2] = { texel.x + 0.5 - place.x, texel.y + 0.5 - place.y };
  const int size[2] = { face.view.width, face.view.height };
  const double pixel = face.edge(place.t);
  std::uint32_t caster, other;
  double here, farther;
  if (!face.occluder(depth.at(texel.x, texel.y), caster, here))
  {
    return false;
  }
  double t = here;
  for (int axis = 0; axis < 2; ++axis)
  {
    glm::ivec2 next = texel;
    next[axis] += offset[axis] < 0.0 ? -1 : 1;
    if (next[axis] < 0 || next[axis] >= size[axis] ||
      !face.occluder(depth.at(next.x, next.y), other, farther) ||
      std::abs(farther - here) > NearbyReach * pixel)
    {
      return false;
    }
    t -= (farther - here) * std::abs(offset[axis]);
  }
  return !(t + TexelBend * pixel + std::max(this->CasterError[caster], error) < place.t);
}

float ShadowBuffer::filtered(
  const Place& place, double width, const SurfacePoint& point, double error, bool weighed) const
{
  TexelWindow x(place.x, width, place.face->view.width);
  TexelWindow y(place.y, width, place.face->view.height);
  x.weigh();
  y.weigh();
  double sum = 0.0;
  bool anyDark = false, anyLit = false;
  for (int j = 0; j < y.count; ++j)
  {
    for (int i = 0; i < x.count; ++i)
    {
      const glm::ivec2 texel(x.first + i, y.first + j);
      const double away =
        std::max(std::abs(texel.x + 0.5 - place.x), std::abs(texel.y + 0.5 - place.y));
      const Answer answer = this->ask(place, texel, point, error, std::max(1.0, 2.0 * away));
      const bool dark = answer == Answer::Dark ||
        (answer == Answer::DarkNearby && !this->endsBefore(place, texel, error));
      const double weight = x.weight[i] * y.weight[j];
      sum += !dark ? 0.0 : weighed ? weight * this->opacity(*place.face, texel) : weight;
      anyDark = anyDark || dark;
      anyLit = anyLit || !dark;
    }
  }
  const bool whole = !anyLit && !weighed;
  return !anyDark ? 0.0f : whole ? 1.0f : static_cast<float>(std::clamp(sum, 0.0, 1.0));
}

float ShadowBuffer::darkness(const SurfacePoint& point, double error, double extent) const
{
  Place place;
  if (!this->lookUp(point.position, place))
  {
    return 0.0f;
  }
  const double width = boxWidth(place, extent);
  if (this->AutomaticBias && !this->isFlat(place, width))
  {
    return this->filtered(place, width, point, error);
  }
  return this->shadows(place, point, error) ? 1.0f : 0.0f;
}

void ShadowBuffer::darkness(const TilePatch& patch, double error, const double* extents,
  std::uint64_t asked, float* darkness) const
{
  const std::uint64_t dark = this->shadows(patch, error, asked);
  for (int i = 0; i < TilePatch::Most; ++i)
  {
    darkness[i] = dark >> i & 1 ? 1.0f : 0.0f;
  }
  constexpr float Beyond = 0.5f * static_cast<float>(WidestBox + 1.0); // of the widest window
  std::uint64_t left = asked, bent = 0;
  for (std::size_t k = 0; k < this->Faces.size() && this->AutomaticBias && left != 0; ++k)
  {
    const Face& face = *this->Faces[k];
    MapPlaces places;
    placeInMap(face.view, face.worldToClip, patch, left, places);
    bent |= left & ~(places.inside | places.outside);
    left &= places.outside;
    if (face.seesCasters && places.inside != 0 &&
      this->answer(face, places, face.around(places, Beyond), error, 2.0 * Beyond + 1.0) ==
        TileAnswer::Unknown)
    {
      bent |= places.inside & ~this->flat(face, places, extents);
    }
  }
  eachBit(bent,
    [&](int i)
    {
      Place place;
      if (this->lookUp(patch.position(i), place))
      {
        const double width = boxWidth(place, extents[i]);
        if (!this->isFlat(place, width))
        {
          darkness[i] = this->filtered(place, width, patch.point(i), error);
        }
      }
    });
}

std::uint64_t ShadowBuffer::flat(
  const Face& face, const MapPlaces& places, const double* extents) const
{
  // Wider windows are looked at one by one.
  const double narrowest =
    0.999 * std::min(face.edge(places.t0 + places.lowT), face.edge(places.t0 + places.highT));
  std::uint64_t narrow = 0;
  eachBit(places.sure, [&](int i) { narrow |= std::uint64_t(extents[i] < narrowest) << i; });
  return !face.occluders.known() || narrow == 0
    ? 0
    : flatWindows(face.view, face.edge, face.texels(), places, narrow);
}
}
