#include "svoShaderCasters.h"

#include "svoLeafError.h"
#include "svoLeafGeometry.h"
#include "svoOctreeArena.h"
#include "svoUniforms.h"
#include "svoWalkReach.h"
#include "svoWorldSize.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace svo
{
namespace
{
/// Boxes of casters are wider than what they hold by so much of the scene: rays come to them in
/// floats.
constexpr double BoxMargin = 4e-7;

struct CasterRecord // in a shader's memory
{
  glm::vec4 rows[3];
  glm::vec4 octree, low, high;
};
constexpr std::size_t CasterTexelCount = 6;
static_assert(sizeof(CasterRecord) == CasterTexelCount * sizeof(glm::vec4), "as svoRayWalk.glsl");

/// How far planes may lie over the contour of them that VTK draws, voxels.
constexpr auto AboveContour = static_cast<float>(CubeError);
}

std::vector<std::size_t> instancesOf(const Scene& scene, bool Instance::*which)
{
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
  {
    const Instance& instance = scene.instances[i];
    if (instance.*which && instance.body->octree && !instance.body->octree.empty())
    {
      indices.push_back(i);
    }
  }
  return indices;
}

double ShaderCasters::largestGap(const View& view) const
{
  double largest = 0.0;
  for (std::size_t c = 0; c < this->Known.size(); ++c)
  {
    const CasterInMemory& caster = this->Known[c];
    const double gap = this->Gaps[c];
    // What looks that coarse is so vast that nine rays meet it if it is seen.
    for (int i = 0; i < 9 && gap > worldPixel(view, view.tNear); ++i)
    {
      const double x = 0.5 * (i % 3) * view.width;
      const double y = 0.5 * (i / 3) * view.height;
      const glm::dvec3 from = caster.toOctree.point(view.rayOrigin(x, y));
      const glm::dvec3 way = caster.toOctree.vector(view.rayDirection(x, y));
      const glm::dvec3 a = (caster.box.low - from) / way;
      const glm::dvec3 b = (caster.box.high - from) / way;
      const glm::dvec3 enters = glm::min(a, b);
      const glm::dvec3 leaves = glm::max(a, b);
      const double first = std::max({ enters.x, enters.y, enters.z, view.tNear });
      if (first <= std::min({ leaves.x, leaves.y, leaves.z, view.tFar }))
      {
        largest = std::max(largest, gap / worldPixel(view, first));
      }
    }
  }
  return largest;
}

bool ShaderCasters::place(const Scene& scene, const OctreeArena& arena)
{
  this->Gaps.clear();
  this->Known.clear();
  this->Alphas.clear();
  this->Planes = false;
  this->WorldToView = glm::dmat4(0.0);
  std::vector<Box> boxes;
  Box all;
  for (const std::size_t index : instancesOf(scene, &Instance::castShadow))
  {
    const Instance& caster = scene.instances[index];
    const Octree& octree = caster.body->octree;
    const float opacity = caster.mappedOpacity
      ? -1.0f - static_cast<float>(this->Alphas.add(caster, inFloats(arena.firstOf(octree))))
      : caster.translucent() ? caster.opacity
                             : 1.0f;
    const double* bounds = octree.header().meshBounds;
    const WorldToOctree toOctree(octree, caster.localToWorld);
    const auto corner = [&](int side)
    {
      return 1.0 +
        (glm::dvec3(bounds[side], bounds[2 + side], bounds[4 + side]) - toOctree.origin) *
        toOctree.scale;
    };
    CasterInMemory record{ index,
      glm::vec4(inFloats(arena.rootOf(octree)), octree.depthCount(), opacity), {}, {}, toOctree,
      { corner(0), corner(1) } };
    if (octree.hasPlanes())
    {
      const LeafQuery query(octree, { LeafGeometry::Plane, MaximumLevel });
      record.low = glm::vec4(glm::vec3(query.low), walkReach(caster));
      record.high = glm::vec4(glm::vec3(query.high), AboveContour);
      this->Planes = true;
    }
    this->Gaps.push_back(worldLeafError(caster, LeafGeometry::Triangle, octree.level()));
    this->Known.push_back(record);
    boxes.push_back(boxAround(bounds, caster.localToWorld));
    all.add(boxes.back());
  }
  this->Centre = all.known() ? 0.5 * (all.low + all.high) : glm::dvec3(0.0);
  for (Box& box : boxes)
  {
    box.low -= this->Centre;
    box.high -= this->Centre;
  }
  this->Tree = makeCasterTree(boxes, BoxMargin);
  const std::size_t texels = 2 * this->Tree.size() + CasterTexelCount * this->Known.size();
  if (texels > BufferTexture::most() ||
    ((texels > this->Texels.size() || texels == 0) &&
      !this->Texels.allocate(texels + texels / 2 + 64)))
  {
    return false;
  }
  this->Texels.send(0, this->Tree.data(), 2 * this->Tree.size());
  return this->Alphas.send();
}

void ShaderCasters::aim(const View& view)
{
  if (this->WorldToView == view.worldToView)
  {
    return;
  }
  this->WorldToView = view.worldToView;
  const glm::dmat3 toWorld = glm::transpose(glm::dmat3(view.worldToView)); // rigid
  std::vector<CasterRecord> records;
  records.reserve(this->Known.size());
  for (const CasterInMemory& caster : this->Known)
  {
    const glm::dmat3 linear = caster.toOctree.inverse * toWorld * caster.toOctree.scale;
    const glm::dvec3 at = caster.toOctree.point(view.eye);
    CasterRecord record{ {}, caster.octree, caster.low, caster.high };
    for (int row = 0; row < 3; ++row)
    {
      record.rows[row] =
        glm::vec4(glm::dvec4(linear[0][row], linear[1][row], linear[2][row], at[row]));
    }
    records.push_back(record);
  }
  this->Texels.send(2 * this->Tree.size(), records.data(), CasterTexelCount * records.size());
}

void ShaderCasters::describe(const View& view, ShaderValues& values) const
{
  glm::dmat4 viewToTree(glm::transpose(glm::dmat3(view.worldToView))); // rigid
  viewToTree[3] = glm::dvec4(view.eye - this->Centre, 1.0);
  const auto nodes = static_cast<int>(this->Tree.size());
  values.textures.push_back({ "svoCasters", this->Texels.name() });
  if (this->alphas().size() > 0)
  {
    values.textures.push_back({ "svoAlphas", this->alphas().name() });
  }
  values.integers.push_back({ "svoTreeSize", { nodes } });
  values.integers.push_back({ "svoFirstCaster", { 2 * nodes } });
  values.floats.push_back(matrixOf("svoViewToTree", viewToTree));
}

void ShaderCasters::release()
{
  this->Texels.release();
  this->Alphas.release();
}
}
