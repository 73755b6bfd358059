// Points spread evenly over a square or a triangle.
//
// Evenly: a straight edge of a shadow, wherever it passes, has as large a share of the points on
// one side as of the area. The mean of the squared error over all straight lines is, but for a
// factor, the energy distance of the points and the area (G. J. Szekely, M. L. Rizzo, J. Stat.
// Plan. Inference 143, 2013; a line divides two points as often as they are far apart). Its
// minimum is looked for downhill (W. K. Mak, V. R. Joseph, "Support points", Ann. Statist. 46,
// 2018) from a lattice of the golden ratio, which has no rows: edges along those of the shape, the
// rule in towns, are counted as well as any. A square grid, which is next to that minimum for all
// directions together, counts those edges worse by half to seven times.
#ifndef svoEvenPoints_h
#define svoEvenPoints_h

#include <cstddef>
#include <map>
#include <vector>

#include <glm/vec2.hpp>

namespace svo
{
class EvenPoints
{
public:
  enum class Shape
  {
    Square,  // (0, 0), (1, 0), (1, 1), (0, 1)
    Triangle // (0, 0), (1, 0), (0, 1), spread as over an equilateral one
  };
  explicit EvenPoints(Shape shape)
    : Of(shape)
  {
  }

  /// To be called for a count before at() is.
  void prepare(std::size_t count);

  /// Point `index` of `count`; the middle of one alone. May be called by several threads.
  glm::dvec2 at(std::size_t index, std::size_t count) const;

private:
  glm::dvec2 onLattice(std::size_t index, std::size_t count) const;
  Shape Of;
  std::map<std::size_t, std::vector<glm::dvec2>> Kept; // by count
};
}

#endif
