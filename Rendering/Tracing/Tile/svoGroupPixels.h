// What triangles of a few pixels leave at the pixels of a group of 4x4 tiles.
//
// Such a triangle is not worth being sorted and drawn tile by tile: it is looked at where it is
// made ready, at each pixel in the box around it, many triangles at a time. What may be met there
// is written down as a point (svoReadyTriangles.cxx) and merged into the group's pixels, which
// know what svoNearestTriangles.cxx knows of a tile's.
#ifndef svoGroupPixels_h
#define svoGroupPixels_h

#include "svoGroupView.h"
#include "vtkSVOTracingModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
/// Pixels where small triangles may be met, one after the other.
struct SeenPoints
{
  /// The sign of `triangle`: TriangleGroup::Steep.
  static constexpr std::uint32_t Steep = 0x80000000u;

  std::size_t count = 0;
  std::vector<std::int32_t> pixel;    // see GroupPixels
  std::vector<float> low, high;       // keys; high: infinity if it may be missed
  std::vector<std::int32_t> triangle; // and Steep

  void makeRoom(std::size_t size);
};

class VTKSVOTRACING_EXPORT GroupPixels
{
public:
  /// Row by row.
  static constexpr int Count = GroupView::Pixels * GroupView::Pixels;
  static constexpr std::int32_t NoPoint = -1;

  /// Points of one instance, up to `end` among all of the group's.
  struct Part
  {
    std::uint32_t owner;
    std::size_t end;
    std::uint32_t tiles; // that they lie in, one bit each
  };

  void clear();
  bool empty() const { return this->Parts.empty(); }

  /// Where points are written to, behind those that there are.
  SeenPoints& points() { return this->Points; }
  const SeenPoints& points() const { return this->Points; }
  /// Merges points that were written since into the pixels. Points of one owner follow one another.
  void merge(std::uint32_t owner);

  /// True if hits of these keys and greater ones come second at all pixels of the box.
  bool hides(int x0, int x1, int y0, int y1, float key) const;

  const std::vector<Part>& parts() const { return this->Parts; }
  /// The points of a pixel that may be met first, as far as was known when they were merged.
  std::int32_t firstPoint(int pixel) const
  {
    return this->empty() ? NoPoint : this->First[static_cast<std::size_t>(pixel)];
  }
  std::int32_t nextPoint(std::int32_t point) const
  {
    return this->Next[static_cast<std::size_t>(point)];
  }
  std::uint32_t ownerOf(std::int32_t point) const;

  const float* upper() const { return this->Upper.data(); }
  const float* lower() const { return this->Lower.data(); }
  const float* rival() const { return this->Rival.data(); }
  /// Likewise of what is met for certain; means nothing where `upper` is infinite.
  const std::uint32_t* triangle() const { return this->Triangle.data(); }
  const std::uint32_t* owner() const { return this->Owner.data(); }

private:
  SeenPoints Points;
  std::vector<Part> Parts;
  std::vector<float> Upper, Lower, Rival; // keys, as DrawnTile has them
  std::vector<std::uint32_t> Triangle, Owner;
  std::vector<std::int32_t> First, Next; // of a pixel; behind a point
};
}

#endif
