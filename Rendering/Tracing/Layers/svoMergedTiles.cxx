#include "svoMergedTiles.h"

#include <algorithm>

namespace svo
{
void MergedTiles::touch(const MergedPart& part)
{
  assert(((part.rect.x0 | part.rect.y0 | part.rect.x1 | part.rect.y1) & 7) == 0);
  this->Grid.eachStretch(part.rect,
    [this](std::size_t first, std::size_t last)
    {
      std::fill(this->Changes.begin() + static_cast<std::ptrdiff_t>(first),
        this->Changes.begin() + static_cast<std::ptrdiff_t>(last), Change::Touched);
    });
  this->ChangedParts.resize(std::max<std::size_t>(this->ChangedParts.size(), part.index + 2), 0);
  if (!this->ChangedParts[part.index])
  {
    this->ChangedParts[part.index] = 1;
    this->ChangedIndices.push_back(part.index);
  }
}

/// Those that were not looked at in the last frame, whose grid has the same places.
void MergedTiles::forgetOthers(const TileGrid& before)
{
  if (before.x0 == this->Grid.x0 && before.y0 == this->Grid.y0)
  {
    return;
  }
  for (std::size_t tile = 0; tile < this->States.size(); ++tile)
  {
    const int x = this->Grid.tileX(tile), y = this->Grid.tileY(tile);
    if (!before.holds(x, y) || !this->Grid.holds(x, y))
    {
      this->States[tile] = Unknown;
      this->Changes[tile] = Change::New;
    }
  }
}

bool MergedTiles::beginFrame(
  const View& view, std::vector<MergedPart>& parts, bool keep, const std::uint8_t* wanted)
{
  const TileGrid before = this->Grid;
  this->Grid = TileGrid(view);
  const std::size_t tiles = this->Grid.size();
  const bool known = keep && this->States.size() == tiles && sameGrid(this->Grid, before) &&
    sameImage(view, this->Seen);
  if (!known)
  {
    this->States.assign(tiles, Unknown);
  }
  this->Changes.assign(tiles, known ? Change::None : Change::New);
  this->ChangedParts.assign(1, 0);
  this->ChangedIndices.clear();
  if (known)
  {
    this->forgetOthers(before);
    // Both are in the order of their indices.
    auto old = this->Parts.begin();
    auto now = parts.begin();
    while (old != this->Parts.end() || now != parts.end())
    {
      if (now == parts.end() || (old != this->Parts.end() && old->index < now->index))
      {
        this->touch(*old++);
      }
      else if (old == this->Parts.end() || now->index < old->index)
      {
        this->touch(*now++);
      }
      else
      {
        if (!(*old == *now))
        {
          this->touch(*old);
          this->touch(*now);
        }
        ++old;
        ++now;
      }
    }
  }
  this->Any = false;
  for (std::size_t tile = 0; tile < tiles; ++tile)
  {
    const bool wants = !wanted || wanted[tile];
    Change& change = this->Changes[tile];
    if (change != Change::None || (wants && this->States[tile] == Unknown))
    {
      if (!wants || this->States[tile] == Unknown)
      {
        change = Change::New;
      }
      this->States[tile] = wants ? Known : Unknown;
      this->Any = true;
    }
  }
  this->Seen = view;
  this->Parts.swap(parts);
  return known;
}
}
