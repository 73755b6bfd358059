// The memory layout of a sparse voxel octree: one linear, position-independent buffer that the
// builder writes, a .vtp file carries, and both the CPU and a shader read.
//
// SPACE
//   The octree's cube is a cube in the object's local coordinates, or in coordinates of its own
//   (TRANSFORMS, below), `2^level` voxels along an edge. A node is a 4x4x4 block: it spans two
//   octree levels at once. Where `level` is odd, the root block would span half a level too much,
//   so the root cube is twice the octree's cube and only its lower octant is used. The root cube is
//   mapped to *octree coordinates* [1, 2)^3, where a float's mantissa bits are the voxel's integer
//   coordinates.
//
//        depth           0 (root)        1                 depthCount - 1 (bricks)
//        block edge      4^depthCount    4^(depthCount-1)  4                          voxels
//        level of its
//        cells           2 - odd         4 - odd           level
//
//   A node's 64 cells are numbered in Morton order, z y x z y x from the highest bit, so that byte
//   number g of the mask (g = 0..7) is one cell of the octree level in between, and the mask of
//   occupied bytes is a level of detail of its own: every octree level can be read off.
//
// MEMORY (little endian)
//
//   +------------------------+ 0
//   | Header       256 bytes |  what it is, where its cube lies, whose mesh it belongs to
//   +------------------------+ 256
//   | Node 0 (root) 16 bytes |  breadth first: all nodes of depth 0, then of depth 1, ...; the
//   | Node 1                 |  children of one node are neighbours, in Morton order, and only
//   | ...                    |  those that exist are stored (that of cell i is at
//   | Node nodeCount - 1     |  first + the number of bits below bit i that mask has: svoNode.h)
//   +------------------------+ 256 + 16 * nodeCount
//   | lists   4 bytes a word |  triangle lists of the bricks that more than one triangle touches:
//   |                        |  count, id, id, ... (ascending); in the order of their bricks, none
//   |                        |  shared. Of an octree of planes instead the plane of every voxel,
//   |                        |  in the order of the voxels
//   +------------------------+ 256 + 16 * nodeCount + 4 * listWords
//   | transform   128 bytes  |  only if transformed is 1, from the next multiple of 8 on
//   +------------------------+
//
//   Node, 16 bytes:
//     0  mask   8  bit i: cell i is occupied. Never 0, but in the root of an empty octree
//     8  first  4  inner node: index of the first child node
//                  brick (last depth): a single triangle's id with InlineTriangle set, else the
//                  index in `lists` of the count that starts its list
//                  brick of an octree of planes: the index in `lists` of its first voxel's plane
//    12  plane  4  the mean plane of the surface in this node's block, see svoPlane.h
//
// OCTREES OF PLANES
//   A surface that is no mesh (where a function or an image takes a value) has no triangles to
//   refer to. Each of its voxels has a plane of its own instead, whose block is the voxel.
//
// TRANSFORMS
//   Voxels of other programs need not be cubes: a grid may be stretched, turned, mirrored or
//   sheared where it lies. Its octree is one of planes, and stays a cube in coordinates of its
//   own, which the 16 doubles of `transform`, a 4x4 matrix row by row, take to the object's local
//   ones. It is affine (last row 0 0 0 1), finite and invertible, of a condition of up to
//   LargestTransformCondition. origin, voxelSize, meshBounds and the planes are in the octree's own
//   coordinates then. Where transformed is 0 both are the same; so it is in files older than
//   transforms.
#ifndef svoLayout_h
#define svoLayout_h

#include <cstddef>
#include <cstdint>

namespace svo
{
/// What a ray meets in a leaf; see Filters/Core/vtkPolyDataToSVO.h for the choice it is.
enum class LeafGeometry : std::uint32_t
{
  Voxel = 0,
  Plane = 1,
  Triangle = 2,
  Automatic = 3
};

/// Octree levels of a node, and its cells along an edge and in all.
constexpr int NodeLevels = 2;
constexpr int NodeEdge = 1 << NodeLevels;
constexpr int NodeCells = NodeEdge * NodeEdge * NodeEdge;

/// Nodes from the root to a brick, of an octree with so many levels.
constexpr int depthsOf(int levels)
{
  return (levels + NodeLevels - 1) / NodeLevels;
}

constexpr int MaximumLevel = 20;
constexpr int MaximumDepths = depthsOf(MaximumLevel);
/// Bits of a float below its exponent: of an octree coordinate, those of the cells.
constexpr int MantissaBits = 23;
static_assert(
  NodeLevels * MaximumDepths <= MantissaBits, "a float tells all voxels of a root cube apart");
constexpr std::uint32_t InlineTriangle = 0x80000000u;

struct Node
{
  std::uint64_t mask;
  std::uint32_t first;
  std::uint32_t plane;
};
static_assert(sizeof(Node) == 16, "a node is 16 bytes on the CPU and one RGBA32UI texel in GLSL");

struct Header
{
  char magic[8];               // "vtkSVO\0\0"
  std::uint32_t version;       // LayoutVersion
  std::uint32_t level;         // 1..MaximumLevel: voxels along an edge of the cube = 2^level
  std::uint32_t depthCount;    // depthsOf(level)
  std::uint32_t leafGeometry;  // LeafGeometry the converter asked for
  std::uint64_t nodeCount;     // nodes of all depths, at least 1 (the root, with an empty mask)
  std::uint64_t listWords;     // 32-bit words in `lists`
  std::uint64_t voxelCount;    // occupied voxels of the last level
  std::uint64_t triangleCount; // of the triangulated mesh; every id in a list is below it
  double origin[3];            // the cube's lower corner, octree's own coordinates
  double voxelSize;            // edge of a voxel, octree's own coordinates
  std::uint64_t signature;     // of the mesh it was built from; 0: not bound to one
  std::uint64_t pointCount;    // of that mesh
  std::uint64_t cellCount;     // of that mesh
  double
    meshBounds[6]; // of that mesh, or of what it is a part of; own coordinates; planes end there
  std::uint32_t depthBegin[MaximumDepths + 1]; // first node of each depth; [depthCount] = nodeCount
  std::uint32_t leafWords;   // words of `lists` that a voxel has; 0: an octree of triangles
  std::uint32_t transformed; // 1: there is a transform; else 0. Of octrees of planes only
  std::uint32_t planeReach;  // 1/16 voxel that planes are seen beyond their voxels; 0: LongestReach
  std::uint32_t reserved[10];
};
static_assert(sizeof(Header) == 256, "the header is part of the file format");

constexpr char LayoutMagic[8] = { 'v', 't', 'k', 'S', 'V', 'O', 0, 0 };
constexpr std::uint32_t LayoutVersion = 1;
/// Header::leafWords of an octree of planes.
constexpr std::uint32_t PlaneWords = 1;
/// Largest Header::planeReach, that of tangent planes, and of files older than that word.
constexpr std::uint32_t LongestReach = 8;

constexpr std::size_t TransformBytes = 16 * sizeof(double);
constexpr double LargestTransformCondition = 1e9;

/// Where the transform is, or would be.
constexpr std::size_t transformOffset(const Header& header)
{
  const std::size_t end =
    sizeof(Header) + header.nodeCount * sizeof(Node) + header.listWords * sizeof(std::uint32_t);
  return (end + sizeof(double) - 1) / sizeof(double) * sizeof(double);
}

/// Bytes of the whole buffer.
constexpr std::size_t bufferSize(const Header& header)
{
  return header.transformed != 0
    ? transformOffset(header) + TransformBytes
    : sizeof(Header) + header.nodeCount * sizeof(Node) + header.listWords * sizeof(std::uint32_t);
}
}

#endif
