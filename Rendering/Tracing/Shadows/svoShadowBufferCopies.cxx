// A shadow buffer's maps, row by row, for rasterised receivers.
#include "svoShadowBuffer.h"

#include <algorithm>
#include <limits>
#include <memory>

namespace svo
{
std::shared_ptr<const std::vector<float>> ShadowBuffer::Face::copyDepth(double base) const
{
  auto copy = std::make_shared<std::vector<float>>(
    static_cast<std::size_t>(this->view.width) * this->view.height,
    std::numeric_limits<float>::infinity());
  const DepthBuffer& depth = this->layers.depthBuffer();
  for (int y = 0; this->seesCasters && y < this->view.height; ++y)
  {
    float* row = copy->data() + static_cast<std::size_t>(y) * this->view.width;
    for (int x = 0; x < this->view.width; ++x)
    {
      std::uint32_t caster;
      double t;
      if (this->occluder(depth.at(x, y), caster, t))
      {
        row[x] = static_cast<float>(t - base);
      }
    }
  }
  return copy;
}

void ShadowBuffer::copyMaps(int light, std::vector<ShadowMap>& maps, int group)
{
  for (const auto& face : this->Faces)
  {
    ShadowMap map;
    map.light = light;
    map.group = group;
    map.view = face->view;
    map.base = std::max(face->view.tNear, 0.0);
    if (!face->copied)
    {
      face->copied = face->copyDepth(map.base);
    }
    map.depth = face->copied;
    if (this->Translucent)
    {
      if (!face->copiedOpacity || face->copiedOpacity->size() != face->copied->size())
      {
        face->copiedOpacity = this->SameOpacity >= 0.0f
          ? std::make_shared<std::vector<float>>(face->copied->size(), this->SameOpacity)
          : face->copyOpacity(this->CasterOpacity);
      }
      map.opacity = face->copiedOpacity;
    }
    for (double error : this->CasterError)
    {
      map.worldBias = std::max(map.worldBias, error);
    }
    for (double voxel : this->CasterVoxel)
    {
      map.casterVoxel = std::max(map.casterVoxel, voxel);
    }
    maps.push_back(std::move(map));
  }
}

std::shared_ptr<const std::vector<float>> ShadowBuffer::Face::copyOpacity(
  const std::vector<float>& ofCasters) const
{
  auto copy = std::make_shared<std::vector<float>>(
    static_cast<std::size_t>(this->view.width) * this->view.height, 0.0f);
  const DepthBuffer& depth = this->layers.depthBuffer();
  for (int y = 0; this->seesCasters && y < this->view.height; ++y)
  {
    float* row = copy->data() + static_cast<std::size_t>(y) * this->view.width;
    for (int x = 0; x < this->view.width; ++x)
    {
      const std::size_t at = depth.at(x, y);
      std::uint32_t caster;
      double t;
      if (this->occluder(at, caster, t))
      {
        row[x] = this->opacities.known() ? this->opacities.at(at) : ofCasters[caster];
      }
    }
  }
  return copy;
}
}
