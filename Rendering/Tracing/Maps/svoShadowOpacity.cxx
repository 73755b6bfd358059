// What a shadow buffer of translucent casters takes of the light.
#include "svoShadowBuffer.h"
#include "svoShadowFilter.h"

#include <algorithm>
#include <cassert>
#include <tuple>

namespace svo
{
namespace
{
bool sameColors(const Attributes& a, const Attributes& b)
{
  const auto names = [](const Attributes& c)
  {
    return std::tie(c.colors, c.colorAssociation, c.colorCoordinates, c.colorTexture,
      c.colorTextureSize, c.version);
  };
  return names(a) == names(b);
}
}

void ShadowBuffer::findSameOpacity()
{
  this->SameOpacity = 0.0f;
  bool same = this->MappedColors.empty();
  for (const float opacity : this->CasterOpacity)
  {
    same = same && (opacity == 0.0f || this->SameOpacity == 0.0f || opacity == this->SameOpacity);
    this->SameOpacity = std::max(this->SameOpacity, opacity);
  }
  this->SameOpacity = same ? this->SameOpacity : -1.0f;
}

/// Of the group's casters; of opaque ones there is nothing to note.
void ShadowBuffer::noteOpacities(
  const Scene& scene, const std::uint8_t* casters, std::uint8_t group)
{
  this->Translucent = group != OpaqueCasters;
  const std::vector<float> opacities = std::move(this->CasterOpacity);
  const std::vector<Attributes> colors = std::move(this->MappedColors);
  this->CasterOpacity.clear();
  this->MappedColors.clear();
  this->Traced = &scene;
  if (!this->Translucent)
  {
    return;
  }
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
  {
    const Instance& instance = scene.instances[i];
    const bool ours = casters[i] == group;
    this->CasterOpacity.push_back(ours ? instance.opacity : 0.0f);
    if (ours && instance.mappedOpacity)
    {
      this->MappedColors.push_back(instance.body->attributes);
    }
  }
  this->CasterOpacity.resize(this->CasterVoxel.size(), 0.0f);
  this->findSameOpacity();
  this->OtherOpacities = opacities != this->CasterOpacity ||
    !std::equal(colors.begin(), colors.end(), this->MappedColors.begin(), this->MappedColors.end(),
      sameColors);
  this->SameMaps = this->SameMaps && !this->OtherOpacities;
}

float ShadowBuffer::opacity(const Face& face, const glm::ivec2& texel) const
{
  std::uint32_t caster;
  double t;
  const std::size_t at = face.layers.hits().depth.at(texel.x, texel.y);
  return !face.occluder(at, caster, t) ? 0.0f
    : face.opacities.known()           ? face.opacities.at(at)
                                       : this->CasterOpacity[caster];
}

float ShadowBuffer::opacity(const Place& place, double width) const
{
  TexelWindow x(place.x, width, place.face->view.width);
  TexelWindow y(place.y, width, place.face->view.height);
  x.weigh();
  y.weigh();
  double sum = 0.0, all = 0.0;
  for (int j = 0; j < y.count; ++j)
  {
    for (int i = 0; i < x.count; ++i)
    {
      const glm::ivec2 texel(x.first + i, y.first + j);
      std::uint32_t caster;
      double t;
      if (place.face->occluder(place.face->layers.hits().depth.at(texel.x, texel.y), caster, t))
      {
        const double weight = x.weight[i] * y.weight[j];
        sum += weight * this->opacity(*place.face, texel);
        all += weight;
      }
    }
  }
  return all > 0.0 ? static_cast<float>(sum / all) : 0.0f;
}

void ShadowBuffer::taken(const TilePatch& patch, double error, const double* extents,
  std::uint64_t asked, float* taken) const
{
  assert(this->Translucent);
  std::uint64_t some = 0;
  if (extents)
  {
    this->darkness(patch, error, extents, asked, taken);
    eachBit(asked, [&](int i) { some |= std::uint64_t(taken[i] > 0.0f) << i; });
  }
  else
  {
    some = this->shadows(patch, error, asked);
    std::fill_n(taken, TilePatch::Most, 0.0f);
  }
  if (this->SameOpacity >= 0.0f)
  {
    eachBit(some, [&](int i) { taken[i] = this->SameOpacity * (extents ? taken[i] : 1.0f); });
    return;
  }
  eachBit(some,
    [&](int i)
    {
      Place place;
      const SurfacePoint point = patch.point(i);
      if (!this->lookUp(point.position, place))
      {
        return; // nothing is taken at the border of what is seen
      }
      if (!extents)
      {
        taken[i] = this->opacity(*place.face, place.nearest());
        return;
      }
      const double width = boxWidth(place, extents[i]);
      taken[i] = taken[i] < 1.0f ? this->filtered(place, width, point, error, true)
                                 : this->opacity(place, width);
    });
}
}
