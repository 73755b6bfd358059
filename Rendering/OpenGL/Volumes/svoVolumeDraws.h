// What is drawn to count shadow volumes: names of buffers in the current context, and ranges in
// them. Plain data; svoShadowVolume.glsl reads it.
#ifndef svoVolumeDraws_h
#define svoVolumeDraws_h

#include "svoShaderValues.h"

#include <vector>

#include <glm/vec4.hpp>

namespace svo
{
struct VolumeDraws
{
  unsigned int triangles = 0, edges = 0, casters = 0, senses = 0; // buffer textures
  /// svoPixelRays; svoParallel; svoProjection, from view coordinates; and svoReach: the linear
  /// depth of what may be seen, less the first number, is at most the second.
  ShaderValues values;

  /// Triangles of copies of a mesh.
  struct Caps
  {
    int firstCaster, casters, firstTriangle, triangles;
  };
  /// Of casters in whose shadow the eye may be, and of others, by Sides.
  struct Part
  {
    int firstEdge = 0, edges = 0;
    std::vector<Caps> caps;
  };
  /// How what lies in a volume is told: by its sides before the point, or by those behind it.
  enum Sides
  {
    Before,
    Behind,
    SidesCount
  };
  struct OfLight
  {
    /// View coordinates: the way towards it, as long as reach, and 0; or its place, and 1.
    glm::vec4 light;
    Part parts[SidesCount];
  };
  bool tellAll = false;        // there are no casters without a volume
  std::vector<OfLight> lights; // by number in the light's code
};
}

#endif
