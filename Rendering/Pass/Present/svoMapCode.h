// Light by shadow maps: what VTK's shaders need to look up a frame's maps.
#ifndef svoMapCode_h
#define svoMapCode_h

#include "svoLightCode.h"
#include "svoMapTextures.h"
#include "svoScene.h"
#include "svoTracer.h"
#include "svoView.h"

#include <cstddef>
#include <string>
#include <vector>

namespace svo
{
/// One renderer's shadow maps as textures, and the code that reads them. All calls are made in the
/// renderer's context.
class MapCode
{
public:
  /// Takes a frame's maps. Only those that are others than last time are sent to OpenGL. No
  /// maps: no code. The bias that the settings have in voxels is added in
  /// those of the coarsest caster, as maps do not hold casters. `lights`: of the maps. `texture`:
  /// Tracer::mapTexture().
  /// Returns a message, empty if all is well: of more maps than OpenGL takes, those of the
  /// brightest lights are there.
  std::string update(const std::vector<ShadowMap>& maps, const std::vector<Light>& lights,
    const View& eye, const FrameSettings& settings, unsigned int texture = 0);
  void release();

  const LightCode& code() const { return this->Code; }

  /// Bytes that OpenGL holds.
  std::size_t memory() const { return this->Maps.memory(); }

private:
  LightCode Code;
  MapTextures Maps;
};
}

#endif
