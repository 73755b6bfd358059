#include "svoOctree.h"

#include "svoLeafTraits.h"
#include "svoMorton.h"
#include "svoNode.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>

#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace svo
{
namespace
{
bool headerIsSane(const Header& h, std::size_t size)
{
  if (std::memcmp(h.magic, LayoutMagic, sizeof(LayoutMagic)) != 0 || h.version != LayoutVersion ||
    h.level < 1 || h.level > static_cast<std::uint32_t>(MaximumLevel) ||
    h.depthCount != static_cast<std::uint32_t>(depthsOf(static_cast<int>(h.level))) ||
    h.nodeCount < 1 || h.nodeCount > 0x7fffffffu || h.listWords > 0x7fffffffu ||
    h.triangleCount > 0x7fffffffu ||
    (h.leafWords != 0 && (h.leafWords != PlaneWords || h.triangleCount != 0)) ||
    h.transformed > (h.leafWords != 0 ? 1u : 0u) ||
    h.planeReach > (h.leafWords != 0 ? LongestReach : 0u) || size != bufferSize(h))
  {
    return false;
  }
  // The cube's edge and its inverse are finite, or nothing in octree coordinates would be.
  const double rootEdge = h.voxelSize * static_cast<double>(1u << (NodeLevels * h.depthCount));
  if (!std::isfinite(h.origin[0] + h.origin[1] + h.origin[2]) || !(h.voxelSize > 0.0) ||
    !std::isfinite(rootEdge) || !std::isfinite(1.0 / rootEdge) || h.leafGeometry >= LeafGeometries)
  {
    return false;
  }
  return h.depthBegin[0] == 0 && h.depthBegin[h.depthCount] == h.nodeCount &&
    std::is_sorted(h.depthBegin, h.depthBegin + h.depthCount + 1) &&
    (h.depthBegin[1] == 1 || h.nodeCount == 1);
}

bool surfaceIsSane(const Surface& surface)
{
  const std::size_t points = surface.points.size();
  // Triples are loaded with a number more (svoLaneTriples-inl.h).
  const bool room = surface.triangles.empty() ||
    (surface.points.capacity() > points && surface.triangles.capacity() > surface.triangles.size());
  return room &&
    std::all_of(surface.triangles.begin(), surface.triangles.end(),
      [points](const glm::uvec3& t) { return t.x < points && t.y < points && t.z < points; });
}

/// What is wrong with an octree of `size` bytes, of at least a header; null if nothing is. Finds
/// its longest list.
const char* damageOf(const Octree& octree, std::size_t size, std::uint32_t& longest)
{
  const Header& h = octree.header();
  const Surface* surface = octree.surface();
  if (!headerIsSane(h, size))
  {
    return "the octree's header is damaged, or of another version";
  }
  if (h.transformed != 0 && !isTransform(octree.transform()))
  {
    return "the octree's transform is not affine and invertible";
  }
  if (surface && (octree.hasPlanes() || surface->triangles.size() != h.triangleCount))
  {
    return "the octree was built from another number of triangles";
  }
  if (surface && !surfaceIsSane(*surface))
  {
    return "a triangle of the octree's surface has a point that is not there, or no room behind "
           "the last";
  }
  if (octree.empty())
  {
    if (h.nodeCount != 1 || h.listWords != 0 || h.voxelCount != 0)
    {
      return "the octree's nodes are damaged";
    }
    return nullptr;
  }
  const std::uint32_t bricks = octree.brickBegin();
  const Node* nodes = octree.nodes();
  const std::uint32_t* lists = octree.lists();
  // Of a root cube that is larger only the lower corner is the octree's cube.
  const int spare = octree.rootBits(0);
  if (nodes[0].mask != occupiedBelow(nodes[0], 0, NodeLevels - spare))
  {
    return "the octree has nodes outside of its cube";
  }
  std::uint64_t next = 1; // children fill each depth in the order of their parents
  // Lists lie in the order of their bricks. Were they shared, a small file could name a long list
  // so often that reading it would never end.
  std::uint64_t nextList = 0;
  std::uint64_t voxels = 0;
  for (std::uint32_t i = 0; i < h.nodeCount; ++i)
  {
    const Node& node = nodes[i];
    bool good = node.mask != 0;
    if (i < bricks)
    {
      good = good && node.first == next;
      next += childCount(node);
    }
    else if (octree.hasPlanes())
    {
      const std::uint64_t words = PlaneWords * static_cast<std::uint64_t>(childCount(node));
      good = good && node.first == nextList && words <= h.listWords - nextList;
      nextList += good ? words : 0;
    }
    else if (node.first & InlineTriangle)
    {
      good = good && (node.first & ~InlineTriangle) < h.triangleCount;
      longest = std::max(longest, 1u);
    }
    else
    {
      good = good && node.first == nextList && nextList < h.listWords && lists[nextList] > 0 &&
        lists[nextList] < h.listWords - nextList;
      for (std::uint32_t k = 1; good && k <= lists[node.first]; ++k)
      {
        good = lists[node.first + k] < h.triangleCount;
      }
      longest = std::max(longest, good ? lists[node.first] : 0u);
      nextList += good ? lists[node.first] + std::uint64_t(1) : 0;
    }
    voxels += i < bricks ? 0 : childCount(node);
    if (!good || (i + 1 == h.depthBegin[1] && h.depthCount > 1 && next != h.depthBegin[2]))
    {
      return "the octree's nodes are damaged";
    }
  }
  // Depth by depth, the children of one depth are exactly the next one.
  std::uint64_t children = 1;
  for (std::uint32_t d = 0; d + 1 < h.depthCount; ++d)
  {
    for (std::uint32_t i = h.depthBegin[d]; i < h.depthBegin[d + 1]; ++i)
    {
      children += childCount(nodes[i]);
    }
    if (children != h.depthBegin[d + 2])
    {
      return "the octree's depths are damaged";
    }
  }
  if (nextList != h.listWords || voxels != h.voxelCount)
  {
    return "the octree's header counts other lists or voxels than there are";
  }
  return nullptr;
}
}

double frobeniusNorm(const glm::dmat3& m)
{
  double sum = 0.0;
  for (int i = 0; i < 9; ++i)
  {
    sum += m[i / 3][i % 3] * m[i / 3][i % 3];
  }
  return std::sqrt(sum);
}

bool isTransform(const glm::dmat4& m)
{
  const double* const numbers = glm::value_ptr(m);
  const glm::dmat3 linear(m);
  const double scale = frobeniusNorm(linear);
  if (!std::all_of(numbers, numbers + 16, [](double v) { return std::isfinite(v); }) ||
    m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0 || !(scale > 0.0) ||
    !std::isfinite(scale) || !std::isfinite(1.0 / scale))
  {
    return false;
  }
  // Scaled first: neither tiny nor huge scales are singular.
  return frobeniusNorm(glm::inverse(linear / scale)) <= LargestTransformCondition;
}

Octree Octree::open(std::shared_ptr<const std::byte> data, std::size_t size,
  std::shared_ptr<const Surface> surface, std::string& error)
{
  if (!data || size < sizeof(Header))
  {
    error = "the octree's data is shorter than its header";
    return {};
  }
  static std::atomic<std::uint64_t> opened{ 0 };
  const auto parts = std::make_shared<Parts>();
  parts->id = ++opened;
  parts->data = std::move(data);
  parts->size = size;
  parts->surface = std::move(surface);
  Octree octree;
  octree.Whole = parts;
  octree.Buffer = parts->data.get();
  if (const char* damage = damageOf(octree, size, parts->longest))
  {
    error = damage;
    return {};
  }
  parts->upper = makeUpperLevels(octree.header(), octree.nodes(), parts->size);
  if (parts->surface)
  {
    parts->shortLists = makeShortLists(octree);
    parts->representatives = BrickRepresentatives(octree.header(), octree.nodes());
  }
  return octree;
}

std::size_t Octree::bytes() const
{
  if (!this->Whole)
  {
    return 0;
  }
  const Parts& parts = *this->Whole;
  return parts.size + (parts.surface ? parts.surface->bytes() : 0) + parts.upper.bytes() +
    parts.shortLists.bytes() + parts.representatives.bytes();
}

glm::dmat4 Octree::localToOctree() const
{
  const Header& h = this->header();
  const double scale = 1.0 / this->rootEdge();
  const glm::dvec3 origin(h.origin[0], h.origin[1], h.origin[2]);
  glm::dmat4 m(scale);
  m[3] = glm::dvec4(1.0 - origin * scale, 1.0);
  return m;
}

glm::dmat4 Octree::transform() const
{
  if (!this->hasTransform())
  {
    return glm::dmat4(1.0);
  }
  double rows[16];
  std::memcpy(rows, this->Buffer + transformOffset(this->header()), TransformBytes);
  return glm::transpose(glm::make_mat4(rows));
}

bool Octree::occupied(glm::ivec3 cell, int level) const
{
  if (level < 0 || level > this->level() || this->empty())
  {
    return false;
  }
  const int size = 1 << level;
  if (cell.x < 0 || cell.y < 0 || cell.z < 0 || cell.x >= size || cell.y >= size || cell.z >= size)
  {
    return false;
  }
  int bits = this->rootBits(level);
  const Node* node = this->nodes();
  for (; bits > NodeLevels; bits -= NodeLevels)
  {
    const int i = cellAt(cell, bits - NodeLevels);
    if (!hasChild(*node, i))
    {
      return false;
    }
    node = this->nodes() + child(*node, i);
  }
  const int above = NodeLevels - bits;
  return occupiedBelow(*node, cellAt(cell << above), above) != 0;
}
}
