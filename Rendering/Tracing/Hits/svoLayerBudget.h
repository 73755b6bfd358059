// What the depth layers of all views together may take, and take.
#ifndef svoLayerBudget_h
#define svoLayerBudget_h

#include <cstddef>

namespace svo
{
struct LayerBudget
{
  std::size_t limit = 0; // bytes
  std::size_t used = 0;  // bytes
};
}

#endif
