// A loose octree over the objects of a scene: T. Ulrich, "Loose Octrees", Game Programming Gems 1
// (2000), with a looseness k of 1.25: the smaller it is, the fewer nodes a view crosses, and the
// smaller is what still has a place. It knows balls with names, nothing of what they enclose.
//
// The cube of edge W is divided into cells of edge W / 2^d at depth d. The loose cell is k times as
// wide about the same middle, so a ball whose centre lies in the cell, and whose radius is at most
// (k - 1) / 2 W / 2^d, lies in the loose cell: depth and cell follow from radius and centre alone,
// without a look at the tree. That cell is the deepest place of an object. It is kept in the first
// node on the way there that has no more than `Bucket` objects in it and below, so sparse regions
// have few nodes. Where an object is kept depends on the set of objects only, not on how that came
// about.
//
//   records   one for each object, by name, 32 bytes:
//             | x y z  4 + 4 + 4 | radius 4 | node 4 | place 4 | depth 1 | .. |
//             coordinates are 32-bit fractions of the cube, so the cell at depth d is their first d
//             bits; the place is a chunk and where in it
//   nodes     24 bytes, eight children side by side; node 0 is the root
//   chunks    192 bytes, in a list for each node: 15 names, and their balls in 65536ths of the
//             node's cell, 8 bytes each. What a view asks lies together, whatever the names.
//
// A move that keeps its node writes the record and the ball. An object is taken out by putting the
// last one into its place. What is freed is used again, so memory stays at what the largest crowd
// needed.
#ifndef svoLooseOctree_h
#define svoLooseOctree_h

#include "svoView.h"
#include "vtkSVOTracingModule.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
/// A ball, world.
struct Ball
{
  glm::dvec3 centre{ 0.0 };
  double radius = 0.0;
};

/// A node as visitors see it.
struct LooseNode
{
  glm::dvec3 centre;   // of its cell, world
  double half;         // half the edge of its loose cell, world; all balls below lie in that cube
  int depth;           // 0 at the root
  std::size_t objects; // kept in it and below
};

/// Objects of a node as visitors see them.
struct LooseObjects
{
  static constexpr std::uint32_t Most = 15; // but there may be any number of outsiders

  const std::uint32_t* objects;
  std::uint32_t count;
  /// Balls that enclose those which were given: their centres half a step above x, y and z, in
  /// `unit`s from `low`; `radius` has what coordinates lack, and is larger by at most 2^-15 of the
  /// edge of the node's cell, 2^-31 of the cube's, and rounding. Most + 1 can be read, but those
  /// beyond `count` mean nothing. Null of outsiders.
  const std::uint16_t *x = nullptr, *y = nullptr, *z = nullptr, *radius = nullptr;
  glm::dvec3 low{ 0.0 };
  double unit = 0.0, noise = 0.0; // `noise`: to be added to radii; world
};

/// What front to back means: from an eye, or along the direction of parallel rays.
struct VisitOrder
{
  glm::dvec3 eye; // world

  /// The eye is far away, against the direction.
  static VisitOrder along(const glm::dvec3& direction)
  {
    constexpr double Far = std::numeric_limits<double>::infinity();
    return { glm::dvec3(direction.x < 0.0 ? Far : -Far, direction.y < 0.0 ? Far : -Far,
      direction.z < 0.0 ? Far : -Far) };
  }
  /// From the eye of a view, or along its rays if they are parallel.
  static VisitOrder of(const View& view)
  {
    return view.parallel ? along(view.direction) : VisitOrder{ view.origin };
  }
};

/// Objects are named by numbers, dense from 0 on: memory goes with the largest. Changes are made by
/// one thread; any number of threads may look while there are none.
class VTKSVOTRACING_EXPORT LooseOctree
{
public:
  static constexpr int MostDepth = 20; // of nodes
  /// Of objects that a node keeps though they have deeper cells.
  static constexpr std::uint32_t Bucket = 60;

  /// The cube: its middle and its edge, world. With a cube that is not finite, or has no edge, all
  /// objects are outsiders.
  LooseOctree(const glm::dvec3& centre, double edge);

  /// Adds an object, or moves it if it is there. Centre and radius, world, of a ball around it. One
  /// that does not fit the cube is an outsider: its centre lies outside of the cube, its radius is
  /// more than (k - 1) / 2 edges or negative, or one of them is not finite.
  void insert(std::uint32_t object, const glm::dvec3& centre, double radius);
  /// Moves an object that is there, and nothing else. False if it is not there.
  bool move(std::uint32_t object, const glm::dvec3& centre, double radius);
  /// False if it was not there.
  bool remove(std::uint32_t object);
  /// Puts what is near in space side by side in memory; what is kept where stays as it is. Where
  /// many objects came in without an order of space, queries take half the time after it. It
  /// takes about as long as inserting a tenth of them.
  void arrange();
  /// Memory for objects below `count` at once.
  void reserve(std::size_t count) { this->Records.reserve(count); }

  bool contains(std::uint32_t object) const
  {
    return object < this->Records.size() && this->Records[object].node != Absent;
  }
  /// Outsiders included.
  std::size_t size() const { return this->Nodes[0].total + this->Outsiders.size(); }
  /// In no order. They are visited always, before all others.
  const std::vector<std::uint32_t>& outsiders() const { return this->Outsiders; }

  /// Visits nodes front to back, depth first, children in the order of their code exclusive-or the
  /// code of the eye's side of the node's middle: of two children whose cells a plane of the node
  /// separates, that on the eye's side first. A node's objects come before its children, in no
  /// order. Nodes that keep nothing, below them neither, are left out.
  ///
  ///   bool onNode(const LooseNode&, std::uint8_t& known)   before its objects; false: skips them,
  ///                                                        and its children
  ///   void onObject(std::uint32_t object)
  ///
  /// `known` is the visitor's own: 0 at the root, and what a node leaves in it its children find.
  /// Allocates nothing.
  template <class OnNode, class OnObject>
  void visit(const VisitOrder& order, OnNode&& onNode, OnObject&& onObject) const
  {
    this->visitGroups(order, onNode,
      [&](const LooseObjects& some, std::uint8_t)
      {
        for (std::uint32_t i = 0; i < some.count; ++i)
        {
          onObject(some.objects[i]);
        }
      });
  }
  /// The same with the objects of a node in groups:
  ///
  ///   void onObjects(const LooseObjects&, std::uint8_t known)   as their node left it
  template <class OnNode, class OnObjects>
  void visitGroups(const VisitOrder& order, OnNode&& onNode, OnObjects&& onObjects) const;

  /// Nodes that there is memory in use for: the root, and eight below each node that has children.
  std::size_t nodes() const { return this->Nodes.size() - 7 - 8 * this->FreeGroups.size(); }
  /// Bytes, what is kept for later included.
  std::size_t memory() const;

private:
  static constexpr std::uint32_t Absent = 0xffffffffu;  // of Record::node
  static constexpr std::uint32_t Outside = 0xfffffffeu; // the same; its place is that in Outsiders
  static constexpr double Units = 4294967296.0;         // along an edge of the cube
  static constexpr double Looseness = 1.25;
  /// The largest radius, units.
  static constexpr float Reach = static_cast<float>(0.5 * (Looseness - 1.0) * Units);

  /// Where an object belongs.
  struct Spot
  {
    std::uint32_t x = 0, y = 0, z = 0; // the unit that the centre lies in
    float radius = -1.0f;              // units, rounded up; negative: it fits nowhere
    bool inside() const { return this->radius >= 0.0f; }
  };
  struct alignas(32) Record : Spot
  {
    std::uint32_t node = Absent;
    std::uint32_t place = 0; // 16 times its chunk, and where in it
    std::uint8_t depth = 0;  // of the node
  };
  struct Node
  {
    std::uint32_t parent = 0;
    std::uint32_t children = 0; // the first of eight; 0: none
    std::uint32_t chunk = 0;    // the one that is filled; 0: none
    std::uint32_t count = 0;    // of its own objects
    std::uint32_t total = 0;    // those below it as well
    std::uint8_t depth = 0;
    std::uint8_t mask = 0; // of children that keep something, themselves or below
  };
  static constexpr std::uint32_t ChunkSize = LooseObjects::Most;
  struct alignas(64) Chunk
  {
    std::uint32_t next = 0; // full
    std::uint32_t objects[ChunkSize] = {};
    // 65536ths of the node's cell; the radius is rounded up, and has what they lack.
    std::uint16_t x[16] = {}, y[16] = {}, z[16] = {}, radius[16] = {};
  };
  static_assert(sizeof(Record) == 32 && sizeof(Node) == 24 && sizeof(Chunk) == 192, "");

  Spot spotOf(const glm::dvec3& centre, double radius) const;
  /// The depth of the cell of a radius in units, at most the reach of the root.
  int depthOf(float radius) const;
  /// What visitors of a node will read comes from memory while others are visited.
  void prefetch(std::uint32_t chunk) const
  {
    const Chunk* c = this->Chunks.data() + chunk;
    __builtin_prefetch(c);
    __builtin_prefetch(c->x);
    __builtin_prefetch(c->z);
  }
  void prefetch(const Node& node) const
  {
    this->prefetch(node.chunk);
    if (node.children != 0)
    {
      const Node* children = this->Nodes.data() + node.children;
      __builtin_prefetch(children);
      __builtin_prefetch(children + 3);
      __builtin_prefetch(children + 6);
    }
  }
  void put(std::uint32_t object, const Spot& spot);
  void writeBall(const Record& record);
  std::uint32_t takeAll(Node& node, std::uint32_t* objects);
  void append(std::uint32_t node, std::uint32_t object);
  void takeOut(std::uint32_t object);
  void enter(std::uint32_t node, std::uint32_t object);
  void sink(std::uint32_t node);
  void leave(std::uint32_t node, std::uint32_t end);
  void collapse(std::uint32_t node);
  std::uint32_t gather(std::uint32_t node, std::uint32_t* objects);
  std::uint32_t childFor(std::uint32_t node, const Record& record);
  void arrange(
    std::uint32_t from, std::uint32_t to, std::vector<Node>& nodes, std::vector<Chunk>& chunks);
  std::uint32_t newChunk();
  void freeGroup(Node& node);

  glm::dvec3 Low; // lower corner of the cube, world
  double PerUnit; // units in the world's unit of length
  double Unit;    // the inverse
  double Noise;   // how far what is computed here may be off by rounding, world

  std::vector<Record> Records;
  std::vector<Node> Nodes;   // in groups of eight; the root has a place in the first
  std::vector<Chunk> Chunks; // the first is none
  std::vector<std::uint32_t> Outsiders, FreeGroups, FreeChunks;
};

template <class OnNode, class OnObjects>
void LooseOctree::visitGroups(const VisitOrder& order, OnNode&& onNode, OnObjects&& onObjects) const
{
  if (!this->Outsiders.empty())
  {
    onObjects(
      LooseObjects{ this->Outsiders.data(), static_cast<std::uint32_t>(this->Outsiders.size()) },
      std::uint8_t{ 0 });
  }
  if (this->Nodes[0].total == 0)
  {
    return;
  }
  struct Waiting
  {
    std::uint32_t node;
    std::uint32_t x, y, z; // lower corner, units
    std::uint8_t known;
  };
  Waiting stack[7 * MostDepth + 8];
  int waiting = 0;
  stack[waiting++] = { 0, 0, 0, 0, 0 };
  const glm::dvec3 eye = (order.eye - this->Low) * this->PerUnit;
  while (waiting > 0)
  {
    Waiting at = stack[--waiting];
    const Node& node = this->Nodes[at.node];
    const std::uint32_t half = 0x80000000u >> node.depth; // of the cell's edge
    const glm::dvec3 middle(static_cast<double>(at.x) + half, static_cast<double>(at.y) + half,
      static_cast<double>(at.z) + half);
    if (!onNode(LooseNode{ this->Low + this->Unit * middle,
                  this->Unit * Looseness * half + this->Noise, node.depth, node.total },
          at.known))
    {
      continue;
    }
    std::uint32_t inChunk = node.count > 0 ? (node.count - 1) % ChunkSize + 1 : 0;
    for (std::uint32_t c = node.chunk; c != 0; c = this->Chunks[c].next)
    {
      const Chunk& chunk = this->Chunks[c];
      this->prefetch(chunk.next);
      onObjects(LooseObjects{ chunk.objects, inChunk, chunk.x, chunk.y, chunk.z, chunk.radius,
                  this->Low + this->Unit * glm::dvec3(at.x, at.y, at.z),
                  this->Unit * half * 0x1p-15, this->Noise },
        at.known);
      inChunk = ChunkSize;
    }
    if (node.mask == 0)
    {
      continue;
    }
    const unsigned side =
      (eye.x >= middle.x ? 1u : 0u) | (eye.y >= middle.y ? 2u : 0u) | (eye.z >= middle.z ? 4u : 0u);
    // The last one first: it waits longest.
    for (unsigned i = 8; i-- > 0;)
    {
      const unsigned child = i ^ side;
      if (node.mask >> child & 1)
      {
        assert(waiting < 7 * MostDepth + 8);
        this->prefetch(this->Nodes[node.children + child]);
        stack[waiting++] = { node.children + child, at.x + (child & 1) * half,
          at.y + (child >> 1 & 1) * half, at.z + (child >> 2) * half, at.known };
      }
    }
  }
}
}

#endif
