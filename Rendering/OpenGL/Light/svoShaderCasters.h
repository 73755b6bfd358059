// What casts in a scene, as svoRayWalk.glsl reads it: a tree of the casters' boxes, their matrices
// and octrees, and the alpha of their colours.
#ifndef svoShaderCasters_h
#define svoShaderCasters_h

#include "svoBufferTexture.h"
#include "svoCasterAlphas.h"
#include "svoCasterTree.h"
#include "svoMapCopies.h"
#include "svoScene.h"
#include "svoShaderValues.h"
#include "svoView.h"

#include <cstddef>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace svo
{
class OctreeArena;

/// Indices of the instances whose octrees hold something, and that cast, or are seen: `which` is
/// &Instance::castShadow, or &Instance::visible.
std::vector<std::size_t> instancesOf(const Scene& scene, bool Instance::*which);

/// In the memory of an OpenGL context, in which all calls are made.
class ShaderCasters
{
public:
  /// Has the casters of a scene, whose octrees `arena` holds, but for where the eye sees them.
  /// False if OpenGL has no room.
  bool place(const Scene& scene, const OctreeArena& arena);
  /// Sends the matrices that take view coordinates to those of their octrees, if they are others
  /// than last time.
  void aim(const View& view);
  void release();

  const std::vector<CasterInMemory>& known() const { return this->Known; }
  const BufferTexture& alphas() const { return this->Alphas.texels(); }
  bool hasPlanes() const { return this->Planes; } // some of their octrees
  std::size_t bytes() const { return this->Texels.bytes() + this->Alphas.texels().bytes(); }

  /// Adds what the walk needs of them in a view.
  void describe(const View& view, ShaderValues& values) const;

  /// FrameStatistics::largestGap: where casters look nearest, since rays from whatever lies there
  /// may begin on the wrong side of their surfaces. 0 if that is nowhere a pixel.
  double largestGap(const View& view) const;

private:
  std::vector<CasterInMemory> Known;
  std::vector<double> Gaps; // from their surfaces to where floats have a ray begin, world
  bool Planes = false;
  glm::dvec3 Centre{ 0.0 }; // of the tree's coordinates, in the world
  std::vector<CasterNode> Tree;
  glm::dmat4 WorldToView{ 0.0 }; // that was sent
  BufferTexture Texels{ BufferTexture::Texel::FourFloats };
  CasterAlphas Alphas;
};
}

#endif
