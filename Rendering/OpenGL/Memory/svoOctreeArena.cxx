#include "svoOctreeArena.h"

#include "svoEraseIf.h"
#include "svoShortLists.h"
#include "svoSurface.h"

#include <algorithm>

#include <glm/vec4.hpp>

namespace svo
{
namespace
{
// As svoRayWalk.glsl has them.
constexpr std::uint32_t NoList = 0xffffffffu;
constexpr std::uint32_t PlanesOfVoxels = 0xfffffffeu;
constexpr std::uint32_t SingleTriangle = 0x80000000u;

/// Nodes with so few triangles end a walk: 8 take 0.6 to 0.8 of the time without them, 64 take
/// 0.8 (Mesa's llvmpipe).
constexpr std::uint32_t FewTriangles = 8;

/// Texels that a shader can number: it counts in signed integers.
constexpr std::size_t MostTexels = std::size_t(1) << 30;

struct Record // a node in a shader's memory
{
  std::uint32_t low, high, first, list;
};
static_assert(sizeof(Record) == sizeof(Node), "a texel");
}

glm::vec2 inFloats(std::uint32_t number)
{
  return { number / 4096, number % 4096 };
}

std::shared_ptr<OctreeArena> OctreeArena::of(const void* context)
{
  static std::map<const void*, std::weak_ptr<OctreeArena>> arenas;
  eraseIf(arenas, [](const auto& entry) { return entry.second.expired(); });
  std::weak_ptr<OctreeArena> alone;
  std::weak_ptr<OctreeArena>& known = context ? arenas[context] : alone;
  std::shared_ptr<OctreeArena> found = known.lock();
  if (!found)
  {
    found = std::make_shared<OctreeArena>();
    known = found;
  }
  return found;
}

bool OctreeArena::hold(const std::vector<const Octree*>& octrees, std::size_t limit)
{
  if (this->mostlyGone())
  {
    this->release();
  }
  const bool fits = this->bytes() <= limit && this->add(octrees, limit);
  if (!fits)
  {
    this->release();
  }
  return fits;
}

/// True if octrees that nobody has any more fill half of what is in use. All that is sent anew then
/// is no more than they were.
bool OctreeArena::mostlyGone() const
{
  std::size_t gone = 0, kept = 0;
  for (const auto& [id, held] : this->Blocks)
  {
    (held.octree.expired() ? gone : kept) += held.size.node * this->Nodes.texelBytes() +
      held.size.word * this->Lists.texelBytes() + held.size.corner * this->Triangles.texelBytes();
  }
  return gone > kept;
}

std::uint32_t OctreeArena::rootOf(const Octree& octree) const
{
  return this->Blocks.at(octree.id()).begin.node;
}

std::uint32_t OctreeArena::firstOf(const Octree& octree) const
{
  const Block& block = this->Blocks.at(octree.id()).begin;
  return octree.hasPlanes() ? block.word : block.corner / 3;
}

bool OctreeArena::add(const std::vector<const Octree*>& octrees, std::size_t limit)
{
  for (const Octree* octree : octrees)
  {
    if (this->Blocks.count(octree->id()) > 0)
    {
      continue;
    }
    const Surface* surface = octree->surface();
    const ShortLists lists = surface ? makeShortLists(*octree, FewTriangles) : ShortLists();
    const Header& header = octree->header();
    Block size;
    size.node = static_cast<std::uint32_t>(header.nodeCount);
    size.word = static_cast<std::uint32_t>(header.listWords + lists.words.size());
    size.corner = static_cast<std::uint32_t>(surface ? 3 * surface->triangles.size() : 0);
    if (!this->makeRoom(size, limit))
    {
      return false;
    }
    this->send(*octree, lists, this->End);
    this->Blocks.emplace(octree->id(), Held{ WeakOctree(*octree), this->End, size });
    this->End.node += size.node;
    this->End.word += size.word;
    this->End.corner += size.corner;
  }
  return true;
}

/// Has room for so much more. What is there stays where it is.
bool OctreeArena::makeRoom(const Block& needed, std::size_t limit)
{
  const std::size_t most = std::min(BufferTexture::most(), MostTexels);
  struct Part
  {
    BufferTexture& texture;
    std::size_t used, more;
  };
  const Part parts[] = { { this->Nodes, this->End.node, needed.node },
    { this->Lists, this->End.word, needed.word },
    { this->Triangles, this->End.corner, needed.corner } };
  // Each has a texel at least: VTK binds no texture that is not there.
  const auto leastOf = [](const Part& part)
  { return std::max<std::size_t>(part.used + part.more, 1); };
  std::size_t bytes = 0;
  for (const Part& part : parts)
  {
    bytes += std::max(part.texture.size(), leastOf(part)) * part.texture.texelBytes();
    if (part.used + part.more > most)
    {
      return false;
    }
  }
  if (bytes > limit)
  {
    return false;
  }
  for (const Part& part : parts)
  {
    const std::size_t least = leastOf(part);
    if (least <= part.texture.size())
    {
      continue;
    }
    // Half as much again, so that a scene that is built up is not copied for each of its octrees;
    // but others need room, too.
    const std::size_t left = limit / 2 > bytes ? limit / 2 - bytes : 0;
    const std::size_t spare =
      std::min({ least / 2, most - least, left / part.texture.texelBytes() });
    if (!part.texture.allocate(least + spare, part.used))
    {
      return false;
    }
    bytes += spare * part.texture.texelBytes();
  }
  return true;
}

void OctreeArena::send(const Octree& octree, const ShortLists& lists, const Block& at)
{
  const Header& header = octree.header();
  const std::uint32_t triangle = at.corner / 3;
  // First the bricks' lists as they are, then those of nodes.
  std::vector<std::uint32_t> words(octree.lists(), octree.lists() + header.listWords);
  const auto ofNodes = static_cast<std::uint32_t>(words.size());
  words.insert(words.end(), lists.words.begin(), lists.words.end());
  for (std::size_t list = 0; !octree.hasPlanes() && list < words.size(); list += words[list] + 1)
  {
    for (std::uint32_t k = 1; k <= words[list]; ++k)
    {
      words[list + k] += triangle;
    }
  }
  std::vector<Record> records(header.nodeCount);
  const std::uint32_t bricks = octree.brickBegin();
  for (std::uint32_t i = 0; i < records.size(); ++i)
  {
    const Node& node = octree.nodes()[i];
    Record& record = records[i];
    record.low = static_cast<std::uint32_t>(node.mask);
    record.high = static_cast<std::uint32_t>(node.mask >> 32);
    record.first = at.node + node.first;
    record.list = NoList;
    if (octree.hasPlanes())
    {
      record.list = i >= bricks ? PlanesOfVoxels : NoList;
      record.first = i >= bricks ? at.word + node.first : record.first;
    }
    else if (i >= bricks)
    {
      record.list = node.first & InlineTriangle
        ? SingleTriangle | (triangle + (node.first & ~InlineTriangle))
        : at.word + node.first;
    }
    else if (lists.begin[i] != ShortLists::None)
    {
      record.list = at.word + ofNodes + lists.begin[i];
    }
  }
  this->Nodes.send(at.node, records.data(), records.size());
  this->Lists.send(at.word, words.data(), words.size());
  if (const Surface* surface = octree.surface())
  {
    std::vector<glm::vec4> corners;
    corners.reserve(3 * surface->triangles.size());
    for (const glm::uvec3& ids : surface->triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        corners.emplace_back(surface->points[ids[k]], 0.0f);
      }
    }
    this->Triangles.send(at.corner, corners.data(), corners.size());
  }
}

void OctreeArena::release()
{
  ++this->Emptied;
  this->Blocks.clear();
  this->End = {};
  this->Nodes.release();
  this->Lists.release();
  this->Triangles.release();
}
}
