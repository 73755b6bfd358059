// What a scene has in the memory of an OpenGL context: its octrees, which the window's other
// renderers share, and which of them cast and are seen.
#ifndef svoHeldScene_h
#define svoHeldScene_h

#include "svoFrame.h"
#include "svoOctreeArena.h"
#include "svoScene.h"
#include "svoSeenSurfaces.h"
#include "svoShaderCasters.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace svo
{
/// All calls are made in the context.
class HeldScene
{
public:
  SeenSurfaces seen;
  ShaderCasters casters; // but for where the eye sees them: aim()

  /// Has the scene there; nothing is done if it is known to be. Why it cannot be, else empty: then
  /// the scene has nothing there.
  const std::string& hold(const Scene& scene, const FrameSettings& settings);
  /// If there are octrees that the scene has not, of earlier frames or other renderers, frees them,
  /// and its own with them: it is to hold() what it needs, which has more room then.
  bool releaseOthers();
  /// Frees what the scene has, but for octrees that others share. It is held in no context then.
  void release();

  /// After hold().
  const OctreeArena& octrees() const { return *this->Octrees; }
  std::size_t bytes() const
  {
    return this->Octrees->bytes() + this->casters.bytes() + this->seen.bytes();
  }

private:
  std::string holdAnew(const Scene& scene, std::size_t limit);
  bool sharesOthers() const { return this->Octrees->count() > this->Asked; }
  void releaseParts();

  std::shared_ptr<OctreeArena> Octrees; // the context's, once something is held
  std::size_t Asked = 0;                // of it
  std::uint64_t Emptied = 0;            // it, when all of the scene was held
  std::uint64_t Version = 0;            // of the scene that was asked for
  std::size_t Limit = 0;                // then
  std::string WhyNot;                   // it could not be held
};

inline const std::string& HeldScene::hold(const Scene& scene, const FrameSettings& settings)
{
  if (!this->Octrees)
  {
    this->Octrees = OctreeArena::of(settings.context);
  }
  const bool known = scene.version != 0 && scene.version == this->Version &&
    this->Limit == settings.gpuMemoryLimit && this->Emptied == this->Octrees->emptied();
  if (!known)
  {
    this->WhyNot = this->holdAnew(scene, settings.gpuMemoryLimit);
    if (!this->WhyNot.empty())
    {
      this->releaseParts();
    }
    this->Version = scene.version;
    this->Limit = settings.gpuMemoryLimit;
    this->Emptied = this->Octrees->emptied();
  }
  return this->WhyNot;
}

inline std::string HeldScene::holdAnew(const Scene& scene, std::size_t limit)
{
  std::vector<const Octree*> octrees;
  std::set<std::uint64_t> ids;
  const auto add = [&](const Octree& octree)
  {
    octrees.push_back(&octree);
    ids.insert(octree.id());
  };
  for (const std::size_t index : instancesOf(scene, &Instance::castShadow))
  {
    const Octree& octree = scene.instances[index].body->octree;
    if (!octree.surface() && !octree.hasPlanes())
    {
      return "OpenGL shaders meet no octrees without triangles or planes";
    }
    add(octree);
  }
  const std::vector<std::size_t> visible = instancesOf(scene, &Instance::visible);
  for (const std::size_t index : visible)
  {
    const Octree& octree = scene.instances[index].body->octree;
    if (!octree.hasPlanes())
    {
      return "OpenGL shaders trace nothing but planes";
    }
    add(octree);
  }
  this->Asked = ids.size();
  for (int once = 0; once < 2; ++once)
  {
    const bool held = this->Octrees->hold(octrees, limit);
    if (held && !this->casters.place(scene, *this->Octrees))
    {
      return "OpenGL has no room for so many casters";
    }
    if (held && !this->seen.place(scene, visible))
    {
      return "OpenGL has no room for so many surfaces without triangles";
    }
    if (held && this->bytes() <= limit)
    {
      return {};
    }
    if (held && !this->sharesOthers())
    {
      break;
    }
    this->Octrees->release();
  }
  return "The octrees do not fit into OpenGL's memory, or into GPUMemoryLimit";
}

inline bool HeldScene::releaseOthers()
{
  const bool others = this->WhyNot.empty() && this->sharesOthers();
  if (others)
  {
    this->Octrees->release();
    this->Version = 0;
  }
  return others;
}

inline void HeldScene::releaseParts()
{
  if (this->Octrees.use_count() == 1)
  {
    this->Octrees->release();
  }
  this->casters.release();
  this->seen.release();
}

inline void HeldScene::release()
{
  this->releaseParts();
  this->Octrees.reset();
  this->Version = 0;
}
}

#endif
