// A tile of 8x8 texels of a light's map, by name.
#ifndef svoLightTile_h
#define svoLightTile_h

#include <cstdint>
#include <vector>

namespace svo
{
/// A shadow buffer of a scene.
struct BufferName
{
  std::uint16_t light; // index into Scene::lights
  std::uint8_t group;  // which of its buffers; LightBuffers
};

struct LightTile
{
  std::uint16_t light; // BufferName
  std::uint8_t group;  // BufferName
  std::uint8_t map;    // of the buffer
  std::uint32_t tile;  // of the map
};
using LightTiles = std::vector<LightTile>;

/// One that is only looked up if others want it.
struct RaisedTile
{
  LightTile tile;
  bool wanted;
};
using RaisedTiles = std::vector<RaisedTile>;
}

#endif
