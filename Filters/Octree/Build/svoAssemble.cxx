#include "svoAssemble.h"

#include "svoBuildStopped.h"
#include "svoNode.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string>

namespace svo
{
namespace
{
constexpr std::size_t NodeBlock = 16384;

/// What a bucket of records or a block of nodes contributes, and after a sum where it starts.
struct Share
{
  std::size_t nodes = 0;
  std::size_t listWords = 0;
};

Share prefixSum(std::vector<Share>& shares)
{
  Share sum;
  for (Share& share : shares)
  {
    const Share own = share;
    share = sum;
    sum.nodes += own.nodes;
    sum.listWords += own.listWords;
  }
  return sum;
}

/// End of the run of records, or keys, that agree with the one at `i`.
std::size_t endOfBrick(const BrickRecord* records, std::size_t i, std::size_t count)
{
  const std::uint64_t key = records[i].key;
  do
  {
    ++i;
  } while (i < count && records[i].key == key);
  return i;
}

Share countBucket(const BrickRecord* records, std::size_t count)
{
  Share share;
  for (std::size_t i = 0, end = 0; i < count; i = end)
  {
    end = endOfBrick(records, i, count);
    ++share.nodes;
    share.listWords += end - i > 1 ? end - i + 1 : 0;
  }
  return share;
}

/// Returns the occupied voxels of a bucket's bricks.
std::size_t fillBucket(const BrickRecord* records, std::size_t count, Share at,
  const TriangleShape* shapes, NodeDepth& bricks, std::uint32_t* lists)
{
  std::size_t voxels = 0;
  for (std::size_t i = 0, end = 0; i < count; i = end, ++at.nodes)
  {
    end = endOfBrick(records, i, count);
    Node node{ 0, 0, 0 };
    for (std::size_t k = i; k < end; ++k)
    {
      node.mask |= records[k].mask;
    }
    if (end - i == 1)
    {
      node.first = records[i].triangle | InlineTriangle;
    }
    else
    {
      node.first = static_cast<std::uint32_t>(at.listWords);
      lists[at.listWords++] = static_cast<std::uint32_t>(end - i);
      for (std::size_t k = i; k < end; ++k)
      {
        lists[at.listWords++] = records[k].triangle;
      }
    }
    const SurfaceMoment moment = brickMoment(records + i, end - i, node.mask, shapes);
    node.plane = planeOfMoment(moment, NodeEdge);
    voxels += static_cast<std::size_t>(childCount(node));
    assert(at.nodes < bricks.size());
    bricks.keys[at.nodes] = records[i].key;
    bricks.nodes[at.nodes] = node;
    bricks.moments[at.nodes] = moment;
  }
  return voxels;
}

/// The parents of a depth whose blocks have an edge of `childEdge` voxels.
NodeDepth makeParents(const NodeDepth& children, float childEdge, Executor& executor)
{
  const std::size_t count = children.size();
  const std::size_t blocks = (count + NodeBlock - 1) / NodeBlock;
  const auto startsParent = [&](std::size_t i)
  { return i == 0 || children.keys[i] / NodeCells != children.keys[i - 1] / NodeCells; };
  const auto cost = [](std::size_t) { return static_cast<double>(NodeBlock); };
  std::vector<Share> shares(blocks);
  executor.run(blocks, 1, 0.0, 1e7, cost,
    [&](std::size_t block)
    {
      const std::size_t end = std::min((block + 1) * NodeBlock, count);
      for (std::size_t i = block * NodeBlock; i < end; ++i)
      {
        shares[block].nodes += startsParent(i);
      }
    });
  NodeDepth parents(prefixSum(shares).nodes);
  executor.run(blocks, 1, 0.0, 1e6, cost,
    [&](std::size_t block)
    {
      std::size_t at = shares[block].nodes;
      const std::size_t end = std::min((block + 1) * NodeBlock, count);
      for (std::size_t i = block * NodeBlock; i < end; ++i)
      {
        if (!startsParent(i))
        {
          continue;
        }
        Node node{ 0, static_cast<std::uint32_t>(i), 0 };
        const std::uint64_t key = children.keys[i] / NodeCells;
        assert(i == 0 || children.keys[i - 1] < children.keys[i]);
        for (std::size_t k = i; k < count && children.keys[k] / NodeCells == key; ++k)
        {
          node.mask |= cellBit(children.keys[k] % NodeCells);
        }
        const SurfaceMoment moment = blockMoment(children.moments.data() + i, node.mask, childEdge);
        node.plane = planeOfMoment(moment, NodeEdge * childEdge);
        parents.keys[at] = key;
        parents.nodes[at] = node;
        parents.moments[at] = moment;
        ++at;
      }
    });
  return parents;
}

std::shared_ptr<std::byte> writeBuffer(const std::vector<NodeDepth>& depths,
  const RawArray<std::uint32_t>& lists, Header& header, Executor& executor)
{
  header.nodeCount = 0;
  for (std::size_t d = 0; d < header.depthCount; ++d)
  {
    header.nodeCount += d < depths.size() ? depths[d].size() : 0;
    checkIndices(header, header.nodeCount, "nodes");
    header.depthBegin[d + 1] = static_cast<std::uint32_t>(header.nodeCount);
  }
  const std::size_t size = bufferSize(header);
  std::shared_ptr<std::byte> data(
    static_cast<std::byte*>(::operator new(size)), [](std::byte* p) { ::operator delete(p); });
  std::memcpy(data.get(), &header, sizeof(Header));
  auto* nodes = reinterpret_cast<Node*>(data.get() + sizeof(Header));
  const auto cost = [](std::size_t) { return static_cast<double>(NodeBlock); };
  for (std::size_t d = 0; d < depths.size(); ++d)
  {
    const NodeDepth& depth = depths[d];
    const bool inner = d + 1 < header.depthCount;
    const std::size_t blocks = (depth.size() + NodeBlock - 1) / NodeBlock;
    executor.run(blocks, 1, 0.0, 5e6, cost,
      [&](std::size_t block)
      {
        const std::size_t end = std::min((block + 1) * NodeBlock, depth.size());
        for (std::size_t i = block * NodeBlock; i < end; ++i)
        {
          Node node = depth.nodes[i];
          node.first += inner ? header.depthBegin[d + 1] : 0;
          nodes[header.depthBegin[d] + i] = node;
        }
      });
  }
  auto* words = reinterpret_cast<std::uint32_t*>(nodes + header.nodeCount);
  words = std::copy_n(lists.data(), lists.size(), words);
  // The rest is the caller's, if there is any.
  std::fill(reinterpret_cast<std::byte*>(words), data.get() + size, std::byte(0));
  return data;
}
}

void checkIndices(const Header& header, std::size_t count, const char* what)
{
  if (count > 0x7fffffffu)
  {
    throw BuildStopped{ BuildStatus::TooLarge,
      "level " + std::to_string(header.level) + " would need more " + what +
        " than an index can name; choose a lower level" };
  }
}

Header makeHeader(const BuildOptions& options, const Cube& cube)
{
  Header header{};
  std::memcpy(header.magic, LayoutMagic, sizeof(LayoutMagic));
  header.version = LayoutVersion;
  header.level = static_cast<std::uint32_t>(options.level);
  header.depthCount = static_cast<std::uint32_t>(depthsOf(options.level));
  header.leafGeometry = static_cast<std::uint32_t>(options.leafGeometry);
  header.voxelSize = std::ldexp(cube.edge, -options.level);
  for (int i = 0; i < 3; ++i)
  {
    header.origin[i] = cube.origin[i];
  }
  return header;
}

NodeDepth makeBricks(const SortedRecords& sorted, const RawArray<TriangleShape>& shapes,
  Header& header, RawArray<std::uint32_t>& lists, Executor& executor)
{
  std::vector<Share> shares(sorted.bucketCount());
  const auto cost = [&](std::size_t i) { return static_cast<double>(sorted.bucketSize(i)); };
  const auto records = [&](std::size_t i) { return sorted.records.data() + sorted.bucketBegin[i]; };
  executor.run(shares.size(), 16, 0.02, 5e6, cost,
    [&](std::size_t i) { shares[i] = countBucket(records(i), sorted.bucketSize(i)); });
  const Share all = prefixSum(shares);
  checkIndices(header, all.nodes, "nodes");
  checkIndices(header, all.listWords, "words of triangle lists");
  NodeDepth bricks(all.nodes);
  lists = RawArray<std::uint32_t>(all.listWords);
  std::vector<std::size_t> voxels(shares.size());
  executor.run(shares.size(), 16, 0.1, 4e5, cost,
    [&](std::size_t i)
    {
      voxels[i] = fillBucket(
        records(i), sorted.bucketSize(i), shares[i], shapes.data(), bricks, lists.data());
    });
  header.voxelCount = std::accumulate(voxels.begin(), voxels.end(), std::uint64_t(0));
  header.listWords = all.listWords;
  return bricks;
}

std::shared_ptr<std::byte> assemble(
  NodeDepth&& bricks, const RawArray<std::uint32_t>& lists, Header& header, Executor& executor)
{
  std::vector<NodeDepth> depths;
  if (bricks.size() == 0)
  {
    // A root alone.
    depths.emplace_back(1);
    depths[0].nodes[0] = { 0, header.depthCount == 1 ? InlineTriangle : 1u, 0 };
    return writeBuffer(depths, lists, header, executor);
  }
  depths.push_back(std::move(bricks));
  float edge = NodeEdge;
  for (std::uint32_t d = 1; d < header.depthCount; ++d, edge *= NodeEdge)
  {
    depths.push_back(makeParents(depths.back(), edge, executor));
    depths[d - 1].moments = {};
    depths[d - 1].keys = {};
  }
  assert(depths.back().size() == 1 && depths.back().keys[0] == 0);
  std::reverse(depths.begin(), depths.end());
  return writeBuffer(depths, lists, header, executor);
}
}
