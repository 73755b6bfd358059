#include "svoMapTextures.h"

#include <algorithm>
#include <limits>

namespace svo
{
namespace
{
constexpr std::size_t FewTiles = 1024; // of a map, room for which does not matter

/// What is looked up where nothing lies: depths, and how opaque it is.
const std::vector<float> EmptyTile = []
{
  std::vector<float> tile(2 * ShadowTexels::InTile, 0.0f);
  std::fill_n(tile.begin(), ShadowTexels::InTile, std::numeric_limits<float>::infinity());
  return tile;
}();
}

/// Tables name tiles by their numbers, which floats have to hold.
std::size_t MapTextures::most()
{
  return std::min(BufferTexture::most(), ShadowTexels::InTile << 24);
}

bool MapTextures::upload(const std::vector<const ShadowMap*>& maps, unsigned int texture)
{
  if (texture != 0)
  {
    this->release();
    this->Borrowed = texture;
    for (const ShadowMap* map : maps)
    {
      this->Tables.push_back(map->layer);
    }
    return true;
  }
  if (!this->fits(maps) && !this->layOut(maps))
  {
    this->release();
    return false;
  }
  for (std::size_t i = 0; i < maps.size(); ++i)
  {
    if (this->Blocks[i].sent.lock() != maps[i]->texels)
    {
      this->send(*maps[i]->texels, this->Blocks[i]);
      this->Blocks[i].sent = maps[i]->texels;
    }
  }
  return true;
}

void MapTextures::release()
{
  this->Borrowed = 0;
  this->Sent.release();
  this->Blocks.clear();
  this->Tables.clear();
}

/// True if all of them have room where the last frame's were.
bool MapTextures::fits(const std::vector<const ShadowMap*>& maps) const
{
  bool fits = this->Sent.size() > 0 && this->Blocks.size() == maps.size();
  for (std::size_t i = 0; fits && i < maps.size(); ++i)
  {
    const ShadowTexels& texels = *maps[i]->texels;
    const Block& block = this->Blocks[i];
    // Half as much again and a few would be too much.
    fits = (texels.held() == 0 || block.table == texels.tiles.size()) &&
      block.stride == texels.stride && block.tiles >= texels.held() &&
      block.tiles <= texels.held() + texels.held() / 2 + FewTiles;
  }
  return fits;
}

/// Makes room for these maps, and a little more. False if OpenGL refuses.
bool MapTextures::layOut(const std::vector<const ShadowMap*>& maps)
{
  this->release(); // before there are others
  // Maps in which nothing lies have one table together.
  const std::size_t tilesAcross = static_cast<std::size_t>(maps.front()->view.width + 7) / 8;
  const std::vector<float> empty(tilesAcross * tilesAcross, 0.0f);
  std::size_t end = EmptyTile.size() + empty.size();
  for (const ShadowMap* map : maps)
  {
    const ShadowTexels& texels = *map->texels;
    if (texels.held() == 0)
    {
      this->Blocks.push_back({ end, 0, 0, texels.stride, {} });
      this->Tables.push_back(static_cast<int>(EmptyTile.size()));
      continue;
    }
    const std::size_t tiles = texels.held() + std::min(texels.held() / 8 + 16, FewTiles);
    this->Blocks.push_back({ end, texels.tiles.size(), tiles, texels.stride, {} });
    this->Tables.push_back(static_cast<int>(end));
    end = this->Blocks.back().texels() + texels.stride * tiles;
  }
  if (end > most() || !this->Sent.allocate(end))
  {
    return false;
  }
  this->Sent.send(0, EmptyTile.data(), EmptyTile.size());
  this->Sent.send(EmptyTile.size(), empty.data(), empty.size());
  return true;
}

void MapTextures::send(const ShadowTexels& texels, const Block& block)
{
  if (block.table == 0)
  {
    return;
  }
  std::vector<float> table(block.table, 0.0f); // EmptyTile
  for (std::size_t tile = 0; tile < texels.tiles.size(); ++tile)
  {
    if (texels.tiles[tile] != ShadowTexels::Nothing)
    {
      table[tile] = static_cast<float>(
        (block.texels() + block.stride * texels.tiles[tile]) / ShadowTexels::InTile);
    }
  }
  this->Sent.send(block.first, table.data(), table.size());
  this->Sent.send(block.texels(), texels.numbers.data(), texels.numbers.size());
}
}
