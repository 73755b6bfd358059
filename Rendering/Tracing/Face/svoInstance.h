// An octree placed in the world, with its look. There may be very many: what the copies of an
// object have in common lies in a record that they share.
#ifndef svoInstance_h
#define svoInstance_h

#include "svoBody.h"
#include "svoDepthOffset.h"
#include "svoShared.h"

#include <cstdint>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// VTK's lighting model for surfaces without textures and PBR.
struct Material
{
  glm::vec3 ambientColor{ 1.0f }; // 0..1; replaced by mapped scalars where there are any
  glm::vec3 diffuseColor{ 1.0f }; // likewise
  glm::vec3 specularColor{ 1.0f };
  float ambient = 0.0f; // coefficients, 0..1
  float diffuse = 1.0f;
  float specular = 0.0f;
  float specularPower = 1.0f;
  bool lighting = true;    // false: the colour as it is
  bool flat = false;       // facet normals even where there are point normals
  bool flatPlanes = false; // of octrees of planes: normals are those of the planes
};

/// One octree placed in the world.
struct Instance
{
  Shared<Body> body;              // its copies have the same
  glm::dmat4 localToWorld{ 1.0 }; // affine, invertible; the caller has checked
  Material material;
  /// Largest projected edge of its voxels, pixels (0: full depth); negative: the frame's.
  double pixelError = -1.0;
  /// Stable identity of the instance from frame to frame (actor, block, path).
  std::uint64_t id = 0;
  /// Another one than the last instance at this place of Scene::instances had where anything of it
  /// differs: itself, its body, or what its arrays hold. 0: it may. Tracers go by it alone.
  std::uint64_t version = 0;
  DepthOffset depthOffset; // shadows know nothing of it
  /// Where the rasteriser draws the same vertices: 1, what it draws is seen; -1, this is seen; 0,
  /// it does not. See svoShownDepth.h.
  int coincidentOrder = 0;
  /// As a caster: the share of a light that it takes away, 0..1.
  float opacity = 1.0f;
  bool visible = true; // false: a rasterised object that only casts
  bool castShadow = true;
  /// The alpha of mapped colours counts in what it takes away of a light; see translucent().
  bool mappedOpacity = false;
  bool receiveShadow = true;

  /// True of what lets light through as a caster. Of each ray from a light it takes the share that
  /// its opacity, times that alpha, has where the ray meets it first, whatever lies behind: a
  /// closed body counts once. Several of them multiply what they leave.
  bool translucent() const { return this->opacity < 1.0f || this->mappedOpacity; }
};
}

#endif
