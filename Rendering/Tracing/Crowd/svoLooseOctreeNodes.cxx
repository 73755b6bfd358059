// What LooseOctree does with its nodes: takes objects in and out, lets them sink where there are
// many, takes them up again where there are few, and keeps what is freed.
#include "svoLooseOctree.h"

#include <algorithm>
#include <cmath>

namespace svo
{
/// The ball of a record into its chunk.
void LooseOctree::writeBall(const Record& record)
{
  Chunk& chunk = this->Chunks[record.place / 16];
  const std::uint32_t i = record.place % 16;
  const int d = record.depth;
  chunk.x[i] = static_cast<std::uint16_t>(record.x << d >> 16);
  chunk.y[i] = static_cast<std::uint16_t>(record.y << d >> 16);
  chunk.z[i] = static_cast<std::uint16_t>(record.z << d >> 16);
  // A centre is known to lie in a cube of these steps, or of units where they are wider; the radius
  // has half its diagonal more, or all of it. At most half a cell, and those.
  const float perUnit = static_cast<float>(1u << d) / 65536.0f;
  const float radius = std::ceil(record.radius * perUnit) + (d <= 16 ? 1.0f : 2.0f * perUnit);
  chunk.radius[i] = static_cast<std::uint16_t>(radius);
}

/// Into the node's own list. Its total counts it already.
void LooseOctree::append(std::uint32_t node, std::uint32_t object)
{
  const std::uint32_t place = this->Nodes[node].count % ChunkSize;
  if (place == 0)
  {
    const std::uint32_t chunk = this->newChunk();
    this->Chunks[chunk].next = this->Nodes[node].chunk;
    this->Nodes[node].chunk = chunk;
  }
  Node& n = this->Nodes[node];
  this->Chunks[n.chunk].objects[place] = object;
  ++n.count;
  Record& record = this->Records[object];
  record.node = node;
  record.place = 16 * n.chunk + place;
  record.depth = n.depth;
  this->writeBall(record);
}

/// Out of its node's own list; totals stay.
void LooseOctree::takeOut(std::uint32_t object)
{
  const Record& record = this->Records[object];
  Node& n = this->Nodes[record.node];
  const std::uint32_t place = --n.count % ChunkSize;
  const Chunk& from = this->Chunks[n.chunk];
  Chunk& to = this->Chunks[record.place / 16];
  const std::uint32_t i = record.place % 16;
  to.objects[i] = from.objects[place];
  to.x[i] = from.x[place];
  to.y[i] = from.y[place];
  to.z[i] = from.z[place];
  to.radius[i] = from.radius[place];
  this->Records[to.objects[i]].place = record.place;
  if (place == 0)
  {
    this->FreeChunks.push_back(n.chunk);
    n.chunk = from.next;
  }
}

/// Takes all objects out of a node's own list, which are no more than a bucket.
std::uint32_t LooseOctree::takeAll(Node& node, std::uint32_t* objects)
{
  assert(node.count <= Bucket);
  const std::uint32_t count = node.count;
  while (node.count > 0)
  {
    const Chunk& chunk = this->Chunks[node.chunk];
    const std::uint32_t some = (node.count - 1) % ChunkSize + 1;
    objects = std::copy_n(chunk.objects, some, objects);
    this->FreeChunks.push_back(node.chunk);
    node.chunk = chunk.next;
    node.count -= some;
  }
  return count;
}

/// Adds an object, whose record has its coordinates, to a node that has its cell or one below it.
void LooseOctree::enter(std::uint32_t node, std::uint32_t object)
{
  const int deepest = this->depthOf(this->Records[object].radius);
  for (;;)
  {
    const std::uint32_t total = ++this->Nodes[node].total;
    if (total == Bucket + 1)
    {
      this->sink(node);
    }
    if (total <= Bucket || this->Nodes[node].depth == deepest)
    {
      this->append(node, object);
      return;
    }
    node = this->childFor(node, this->Records[object]);
  }
}

/// Objects of a node that had no more than a bucket go to their cells below it.
void LooseOctree::sink(std::uint32_t node)
{
  assert(this->Nodes[node].children == 0);
  std::uint32_t objects[Bucket];
  const std::uint32_t count = this->takeAll(this->Nodes[node], objects);
  const int depth = this->Nodes[node].depth;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const Record& record = this->Records[objects[i]];
    if (this->depthOf(record.radius) == depth)
    {
      this->append(node, objects[i]);
    }
    else
    {
      this->enter(this->childFor(node, record), objects[i]);
    }
  }
}

/// Counts one less in a node and in those above it, below `end` (Absent: the root as well), and
/// reclaims what is too empty there.
void LooseOctree::leave(std::uint32_t node, std::uint32_t end)
{
  std::uint32_t sparse = Absent;
  while (node != end)
  {
    Node& n = this->Nodes[node];
    --n.total;
    if (n.total == Bucket && n.children != 0)
    {
      sparse = node;
    }
    if (node == 0)
    {
      break;
    }
    const std::uint32_t parent = n.parent;
    if (n.total == 0)
    {
      Node& p = this->Nodes[parent];
      p.mask &= static_cast<std::uint8_t>(~(1u << (node - p.children)));
      if (p.mask == 0)
      {
        this->freeGroup(p);
      }
    }
    node = parent;
  }
  if (sparse != Absent)
  {
    this->collapse(sparse); // the uppermost one
  }
}

/// Takes up all objects below a node: no more than a bucket.
void LooseOctree::collapse(std::uint32_t node)
{
  std::uint32_t objects[Bucket];
  const std::uint32_t count = this->gather(node, objects);
  for (std::uint32_t i = 0; i < count; ++i)
  {
    this->append(node, objects[i]);
  }
}

/// Writes the objects below a node and frees all of it; returns how many they are.
std::uint32_t LooseOctree::gather(std::uint32_t node, std::uint32_t* objects)
{
  Node& n = this->Nodes[node];
  std::uint32_t count = 0;
  if (n.children == 0)
  {
    return count;
  }
  for (std::uint32_t i = 0; i < 8; ++i)
  {
    count += this->takeAll(this->Nodes[n.children + i], objects + count);
    count += this->gather(n.children + i, objects + count);
  }
  this->freeGroup(n);
  return count;
}

/// The child that a record's coordinates lie in, made if it is not there; its total is not changed.
std::uint32_t LooseOctree::childFor(std::uint32_t node, const Record& record)
{
  if (this->Nodes[node].children == 0)
  {
    std::uint32_t group = static_cast<std::uint32_t>(this->Nodes.size());
    if (this->FreeGroups.empty())
    {
      this->Nodes.resize(this->Nodes.size() + 8);
    }
    else
    {
      group = this->FreeGroups.back();
      this->FreeGroups.pop_back();
    }
    Node fresh;
    fresh.parent = node;
    fresh.depth = static_cast<std::uint8_t>(this->Nodes[node].depth + 1);
    std::fill_n(this->Nodes.begin() + group, 8, fresh);
    this->Nodes[node].children = group;
  }
  Node& n = this->Nodes[node];
  const int shift = 31 - n.depth;
  const std::uint32_t child =
    (record.x >> shift & 1) | (record.y >> shift & 1) << 1 | (record.z >> shift & 1) << 2;
  n.mask |= static_cast<std::uint8_t>(1u << child);
  return n.children + child;
}

void LooseOctree::freeGroup(Node& node)
{
  this->FreeGroups.push_back(node.children);
  node.children = 0;
  node.mask = 0;
}

std::uint32_t LooseOctree::newChunk()
{
  if (this->FreeChunks.empty())
  {
    this->Chunks.emplace_back();
    return static_cast<std::uint32_t>(this->Chunks.size() - 1);
  }
  const std::uint32_t chunk = this->FreeChunks.back();
  this->FreeChunks.pop_back();
  return chunk;
}

void LooseOctree::arrange()
{
  std::vector<Node> nodes(8);
  std::vector<Chunk> chunks(1);
  nodes.reserve(this->Nodes.size() - 8 * this->FreeGroups.size());
  chunks.reserve(this->Chunks.size() - this->FreeChunks.size());
  this->arrange(0, 0, nodes, chunks);
  this->Nodes.swap(nodes);
  this->Chunks.swap(chunks);
  this->FreeGroups.clear();
  this->FreeChunks.clear();
}

/// Copies a node and all below it behind what has been copied, depth first.
void LooseOctree::arrange(
  std::uint32_t from, std::uint32_t to, std::vector<Node>& nodes, std::vector<Chunk>& chunks)
{
  const Node& node = this->Nodes[from];
  nodes[to].count = node.count;
  nodes[to].total = node.total;
  nodes[to].depth = node.depth;
  nodes[to].mask = node.mask;
  std::uint32_t inChunk = node.count > 0 ? (node.count - 1) % ChunkSize + 1 : 0;
  for (std::uint32_t c = node.chunk; c != 0; c = this->Chunks[c].next)
  {
    const std::uint32_t chunk = static_cast<std::uint32_t>(chunks.size());
    (c == node.chunk ? nodes[to].chunk : chunks.back().next) = chunk;
    chunks.push_back(this->Chunks[c]);
    for (std::uint32_t i = 0; i < inChunk; ++i)
    {
      Record& record = this->Records[chunks.back().objects[i]];
      record.node = to;
      record.place = 16 * chunk + i;
    }
    inChunk = ChunkSize;
  }
  if (node.children == 0)
  {
    return;
  }
  const std::uint32_t group = static_cast<std::uint32_t>(nodes.size());
  nodes[to].children = group;
  nodes.resize(nodes.size() + 8);
  for (std::uint32_t i = 0; i < 8; ++i)
  {
    nodes[group + i].parent = to;
    this->arrange(node.children + i, group + i, nodes, chunks);
  }
}
}
