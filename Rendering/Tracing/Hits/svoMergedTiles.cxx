#include "svoMergedTiles.h"

#include <algorithm>

namespace svo
{
void MergedTiles::touch(const MergedPart& part, int tilesX)
{
  const PixelRect& rect = part.rect;
  assert(((rect.x0 | rect.y0 | rect.x1 | rect.y1) & 7) == 0);
  for (int y = rect.y0 / 8; y < rect.y1 / 8; ++y)
  {
    const auto row = this->Changes.begin() + static_cast<std::ptrdiff_t>(y) * tilesX;
    std::fill(row + rect.x0 / 8, row + rect.x1 / 8, Change::Touched);
  }
  this->ChangedParts.resize(std::max<std::size_t>(this->ChangedParts.size(), part.index + 2), 0);
  if (!this->ChangedParts[part.index])
  {
    this->ChangedParts[part.index] = 1;
    this->ChangedIndices.push_back(part.index);
  }
}

bool MergedTiles::beginFrame(
  const View& view, std::vector<MergedPart>& parts, bool keep, const std::uint8_t* wanted)
{
  const int tilesX = (view.width + 7) / 8;
  const std::size_t tiles = static_cast<std::size_t>(tilesX) * ((view.height + 7) / 8);
  const bool known = keep && this->States.size() == tiles && sameRays(view, this->Seen);
  if (!known)
  {
    this->States.assign(tiles, Unknown);
  }
  this->Changes.assign(tiles, known ? Change::None : Change::New);
  this->ChangedParts.assign(1, 0);
  this->ChangedIndices.clear();
  if (known)
  {
    // Both are in the order of their indices.
    auto old = this->Parts.begin();
    auto now = parts.begin();
    while (old != this->Parts.end() || now != parts.end())
    {
      if (now == parts.end() || (old != this->Parts.end() && old->index < now->index))
      {
        this->touch(*old++, tilesX);
      }
      else if (old == this->Parts.end() || now->index < old->index)
      {
        this->touch(*now++, tilesX);
      }
      else
      {
        if (!(*old == *now))
        {
          this->touch(*old, tilesX);
          this->touch(*now, tilesX);
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
