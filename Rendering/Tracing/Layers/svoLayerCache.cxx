#include "svoLayerCache.h"

namespace svo
{
void LayerCache::drop(Entry& kept, LayerBudget& budget)
{
  if (kept.layer)
  {
    this->Memory -= kept.layer->bytes();
    budget.used -= kept.layer->bytes();
    kept.layer.reset();
  }
}

void LayerCache::beginFrame(bool keep, bool moved, LayerBudget& budget)
{
  this->Keep = keep;
  this->Moved = moved;
  const bool dropped = !keep || moved || budget.used > budget.limit;
  for (auto& kept : this->Layers)
  {
    kept.second.used = false;
    if (dropped)
    {
      this->drop(kept.second, budget);
    }
  }
  if (!keep)
  {
    this->Layers.clear();
  }
}

DepthLayer* LayerCache::layerOf(
  std::uint64_t id, const LayerKey& key, const PixelRect& rect, LayerBudget& budget)
{
  if (!this->Keep)
  {
    return nullptr;
  }
  const auto inserted = this->Layers.try_emplace(id);
  Entry& kept = inserted.first->second;
  if (kept.used)
  {
    return nullptr;
  }
  kept.used = true;
  const bool changed = !inserted.second && !(kept.key == key);
  kept.key = key;
  if (changed)
  {
    this->drop(kept, budget);
  }
  if (changed || this->Moved)
  {
    return nullptr;
  }
  if (!kept.layer)
  {
    auto layer = std::make_unique<DepthLayer>(rect);
    if (budget.used + layer->bytes() <= budget.limit)
    {
      this->Memory += layer->bytes();
      budget.used += layer->bytes();
      kept.layer = std::move(layer);
    }
  }
  return kept.layer.get();
}

void LayerCache::endFrame(LayerBudget& budget)
{
  for (auto kept = this->Layers.begin(); kept != this->Layers.end();)
  {
    if (kept->second.used)
    {
      ++kept;
      continue;
    }
    this->drop(kept->second, budget);
    kept = this->Layers.erase(kept);
  }
}

void LayerCache::clear()
{
  this->Layers.clear();
  this->Memory = 0;
}
}
