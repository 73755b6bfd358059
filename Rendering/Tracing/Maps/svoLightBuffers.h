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
#include <vector>

namespace svo
{
class LightBuffers
{
public:
  /// As ShadowBuffer::prepare(), with `culling`. `light`: index into Scene::lights.
  void prepare(std::size_t light, const Scene& scene, const LightMaps& maps, std::size_t first,
    const FrameSettings& settings, const Culling& culling, LayerBudget& budget,
    const ParallelFor& parallelFor)
  {
    this->Light = static_cast<std::uint16_t>(light);
    const std::size_t before = this->All.size();
    this->All.resize(1 + static_cast<std::size_t>(maps.translucentGroups));
    this->SameNumber = this->All.size() == before;
    for (std::size_t group = 0; group < this->All.size(); ++group)
    {
      std::unique_ptr<ShadowBuffer>& buffer = this->All[group];
      if (!buffer)
      {
        buffer = std::make_unique<ShadowBuffer>();
      }
      buffer->setCulling(culling);
      buffer->prepare(scene, maps, first, settings, budget,
        static_cast<std::uint8_t>(OpaqueCasters + group), parallelFor);
    }
  }

  const ShadowBuffer& opaque() const { return *this->All.front(); }
  BufferName nameOfOpaque() const { return { this->Light, 0 }; }
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
  void mark(const TilePatch& patch, LightTiles& noted) const
  {
    for (std::size_t group = 0; group < this->All.size(); ++group)
    {
      this->All[group]->mark(patch, { this->Light, static_cast<std::uint8_t>(group) }, noted);
    }
  }
  void copyMaps(std::vector<ShadowMap>& maps) const
  {
    for (std::size_t group = 0; group < this->All.size(); ++group)
    {
      this->All[group]->copyMaps(this->Light, maps, static_cast<int>(group));
    }
  }

private:
  std::vector<std::unique_ptr<ShadowBuffer>> All; // of opaque casters first
  std::uint16_t Light = 0;
  bool SameNumber = false;
};
}

#endif
