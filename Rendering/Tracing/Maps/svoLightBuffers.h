// The shadow buffers of one light: that of its opaque casters, and one of each group of translucent
// ones (svoTranslucentGroups.h).
#ifndef svoLightBuffers_h
#define svoLightBuffers_h

#include "svoLightTile.h"
#include "svoShadowBuffer.h"
#include "svoTranslucentGroups.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace svo
{
class LightBuffers
{
public:
  /// As ShadowBuffer::prepare(), with `culling`.
  void prepare(const Scene& scene, const LightMaps& maps, std::size_t first,
    const FrameSettings& settings, const Culling& culling, LayerBudget& budget,
    const ParallelFor& parallelFor)
  {
    const std::size_t before = this->All.size();
    this->All.resize(1 + static_cast<std::size_t>(maps.translucentGroups));
    this->SameNumber = this->All.size() == before;
    for (std::size_t group = 0; group < this->All.size(); ++group)
    {
      std::unique_ptr<ShadowBuffer>& buffer = this->All[group];
      buffer = buffer ? std::move(buffer) : std::make_unique<ShadowBuffer>();
      buffer->setCulling(culling);
      buffer->prepare(scene, maps, first, settings, budget,
        static_cast<std::uint8_t>(OpaqueCasters + group), parallelFor);
    }
  }

  const ShadowBuffer& opaque() const { return *this->All.front(); }
  std::vector<const ShadowBuffer*> translucent() const
  {
    std::vector<const ShadowBuffer*> buffers;
    std::for_each(this->All.begin() + 1, this->All.end(),
      [&buffers](const auto& buffer) { buffers.push_back(buffer.get()); });
    return buffers;
  }
  template <class F>
  void each(const F& f) const
  {
    for (const auto& buffer : this->All)
    {
      f(*buffer);
    }
  }
  /// Whose tile it is.
  ShadowBuffer& of(const LightTile& tile) const
  {
    assert(tile.group < this->All.size());
    return *this->All[tile.group];
  }

  /// ShadowBuffer::sameMaps() of all, and there were as many.
  bool sameMaps() const
  {
    return this->SameNumber &&
      std::all_of(
        this->All.begin(), this->All.end(), [](const auto& buffer) { return buffer->sameMaps(); });
  }
  /// `light`: index into Scene::lights.
  void mark(const TilePatch& patch, std::uint16_t light, LightTiles& noted) const
  {
    for (std::size_t group = 0; group < this->All.size(); ++group)
    {
      this->All[group]->mark(patch, { light, static_cast<std::uint8_t>(group) }, noted);
    }
  }
  void copyMaps(int light, std::vector<ShadowMap>& maps) const
  {
    for (std::size_t group = 0; group < this->All.size(); ++group)
    {
      this->All[group]->copyMaps(light, maps, static_cast<int>(group));
    }
  }

private:
  std::vector<std::unique_ptr<ShadowBuffer>> All; // of opaque casters first
  bool SameNumber = false;
};
}

#endif
