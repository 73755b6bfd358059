// Takes entries out of a container where they are not wanted any more (C++20 has it).
#ifndef svoEraseIf_h
#define svoEraseIf_h

#include <iterator>

namespace svo
{
/// Those of which `unwanted(entry)` is true. Of maps, sets and short vectors.
template <class Container, class Unwanted>
void eraseIf(Container& container, const Unwanted& unwanted)
{
  for (auto entry = container.begin(); entry != container.end();)
  {
    entry = unwanted(*entry) ? container.erase(entry) : std::next(entry);
  }
}
}

#endif
