// A tree of boxes in the order in which a ray walks it: the nodes below one follow it, and each
// knows which node comes after those. A shader needs no stack for it.
#ifndef svoCasterTree_h
#define svoCasterTree_h

#include "svoBox.h"

#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
struct CasterNode
{
  glm::vec3 low;
  float after; // index of the node that follows all that is below
  glm::vec3 high;
  float caster; // index into the boxes; -1: nodes are below
};
static_assert(sizeof(CasterNode) == 32, "two texels");

/// Of boxes that are known and finite. A function of the boxes: halves in Morton order of their
/// centres. Rounding makes boxes wider, by `margin` of the largest coordinate.
std::vector<CasterNode> makeCasterTree(const std::vector<Box>& boxes, double margin);
}

#endif
