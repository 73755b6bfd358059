// Which instances reach into each group of tiles of an image.
#ifndef svoGroupLists_h
#define svoGroupLists_h

#include "svoView.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
/// Lists of rectangles, one behind the other: what it takes goes with what the rectangles cover,
/// not with their number times that of the groups.
class GroupLists
{
public:
  struct List
  {
    const std::uint32_t *first, *last;
    const std::uint32_t* begin() const { return this->first; }
    const std::uint32_t* end() const { return this->last; }
  };

  /// Groups of `pixels` x `pixels`, of which `all` covers some. rectOf(i) of each i of `order` lies
  /// inside of `all` and is not empty.
  template <class RectOf>
  void fill(
    const PixelRect& all, int pixels, const std::vector<std::uint32_t>& order, const RectOf& rectOf)
  {
    this->X0 = all.x0 / pixels;
    this->Y0 = all.y0 / pixels;
    this->Columns = (all.x1 + pixels - 1) / pixels - this->X0;
    this->Rows = (all.y1 + pixels - 1) / pixels - this->Y0;
    this->Begin.assign(this->groups() + 1, 0);
    const auto each = [&](const auto& visit)
    {
      for (const std::uint32_t i : order)
      {
        const PixelRect& r = rectOf(i);
        assert(r.x0 >= all.x0 && r.y0 >= all.y0 && r.x1 <= all.x1 && r.y1 <= all.y1);
        for (int y = r.y0 / pixels; y <= (r.y1 - 1) / pixels; ++y)
        {
          for (int x = r.x0 / pixels; x <= (r.x1 - 1) / pixels; ++x)
          {
            visit(static_cast<std::size_t>(y - this->Y0) * this->Columns + (x - this->X0), i);
          }
        }
      }
    };
    each([&](std::size_t group, std::uint32_t) { ++this->Begin[group + 1]; });
    for (std::size_t group = 0; group < this->groups(); ++group)
    {
      this->Begin[group + 1] += this->Begin[group];
    }
    this->Members.resize(this->Begin.back());
    std::vector<std::size_t> next = this->Begin;
    each([&](std::size_t group, std::uint32_t i) { this->Members[next[group]++] = i; });
  }

  std::size_t groups() const { return static_cast<std::size_t>(this->Columns) * this->Rows; }
  int columns() const { return this->Columns; }
  /// Where a group is, in groups.
  int x(std::size_t group) const { return this->X0 + static_cast<int>(group % this->Columns); }
  int y(std::size_t group) const { return this->Y0 + static_cast<int>(group / this->Columns); }
  /// Of a group, in the order that was given.
  List of(std::size_t group) const
  {
    assert(group < this->groups());
    return { this->Members.data() + this->Begin[group],
      this->Members.data() + this->Begin[group + 1] };
  }

private:
  int X0 = 0, Y0 = 0, Columns = 0, Rows = 0;
  std::vector<std::size_t> Begin;
  std::vector<std::uint32_t> Members;
};
}

#endif
