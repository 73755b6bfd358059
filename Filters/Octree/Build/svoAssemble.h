// From sorted records to the buffer of svoLayout.h.
#ifndef svoAssemble_h
#define svoAssemble_h

#include "svoRecords.h"

#include <cstddef>
#include <memory>

namespace svo
{
/// Thrown, and caught by build(), where an index of the layout would overflow.
struct LayoutOverflow
{
  const char* what;
};

/// Fills the counts of the header and returns the whole buffer, of `size` bytes. The level, the
/// depths and the cube must be in the header already. Frees the records.
std::shared_ptr<std::byte> assemble(SortedRecords&& records, const RawArray<TriangleShape>& shapes,
  Header& header, std::size_t& size, Executor& executor);
}

#endif
