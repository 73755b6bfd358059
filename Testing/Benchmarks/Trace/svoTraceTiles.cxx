#include "svoTraceTiles.h"

#include <algorithm>

namespace svobench
{
TracedTiles::TracedTiles(const svo::Octree& octree, const svo::View& view)
  : View(view)
{
  svo::Instance instance;
  instance.body.own().octree = octree;
  instance.body.own().leafGeometry = svo::LeafGeometry::Triangle;
  instance.id = 1;
  this->Scene.instances = { instance };
}

void TracedTiles::trace()
{
  svo::LayerBudget budget;
  const auto all = [](const svo::Instance&) { return true; };
  const auto last = [](const svo::Instance& instance, const svo::LocalView&)
  { return instance.body->octree.level(); };
  if (this->Layers.prepare(this->Scene, this->View, all, last, false, budget))
  {
    this->Layers.trace(svo::serialFor, nullptr);
  }
}

std::vector<svo::HitBlock> TracedTiles::hits(double base) const
{
  const svo::DepthBuffer& depth = this->Layers.hits().depth;
  const float further = static_cast<float>(this->Layers.hits().base(0) - base);
  std::vector<svo::HitBlock> hits(depth.tiles());
  for (std::size_t tile = 0; tile < hits.size(); ++tile)
  {
    svo::HitBlock& block = hits[tile];
    std::fill_n(block.primitive, svo::RayBlock::Size, svo::NoPrimitive);
    for (std::size_t i = 0; depth.hit[tile] && i < svo::RayBlock::Size; ++i)
    {
      const std::size_t at = 64 * tile + i;
      block.primitive[i] =
        depth.instance[at] == svo::NoInstance ? svo::NoPrimitive : depth.primitive[at];
      block.t[i] = depth.t[at] + further;
    }
  }
  return hits;
}
}
