// The executor that a caller hands in, so that an algorithm reads the same sequential or parallel.
#ifndef svoParallel_h
#define svoParallel_h

#include <cstddef>
#include <functional>

namespace svo
{
/// Runs body(first, last) over disjoint ranges that together are [begin, end), each at most about
/// `grain` long, in any order and on any thread; returns when all are done. Results must not depend
/// on how the range was cut.
using ParallelFor = std::function<void(std::size_t begin, std::size_t end, std::size_t grain,
  const std::function<void(std::size_t, std::size_t)>& body)>;

/// The executor without threads.
inline void serialFor(std::size_t begin, std::size_t end, std::size_t,
  const std::function<void(std::size_t, std::size_t)>& body)
{
  if (begin < end)
  {
    body(begin, end);
  }
}

/// Runs body(i) for each i of [0, count).
template <typename Body>
void forEach(const ParallelFor& parallelFor, std::size_t count, std::size_t grain, const Body& body)
{
  parallelFor(0, count, grain,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        body(i);
      }
    });
}
}

#endif
