// What an octree consists of, to compare two builds bit for bit.
#ifndef svoOctreeBytes_h
#define svoOctreeBytes_h

#include "svoOctree.h"

#include <cstddef>
#include <vector>

namespace svotest
{
inline std::vector<std::byte> bytesOf(const svo::Octree& octree)
{
  const auto* first = reinterpret_cast<const std::byte*>(octree.key());
  return { first, first + svo::bufferSize(octree.header()) };
}
}

#endif
