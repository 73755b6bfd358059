// How opaque the cells of a mesh are, by its mapped colours.
#ifndef svoCellAlpha_h
#define svoCellAlpha_h

#include "svoAttributes.h"

#include "vtkType.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace svo
{
/// The least and the most alpha of cells, by colours of cells, of points, and of what lies between
/// those of points where scalars are interpolated before they are mapped. Cells without colours,
/// and with those of leaves, are opaque.
class CellAlpha
{
public:
  /// `attributes` have to outlive it.
  explicit CellAlpha(const Attributes& attributes)
    : Colors(attributes)
  {
    for (int i = 0; attributes.colorCoordinates && i < attributes.colorTextureSize; ++i)
    {
      const unsigned char alpha = attributes.colorTexture[4 * i + 3];
      this->Clear.push_back(this->Clear.back() + (alpha < 255));
      this->Visible.push_back(this->Visible.back() + (alpha > 0));
    }
  }

  struct Range
  {
    bool opaque, invisible;
    double mean = 0.0; // of the corners, 0..1
  };

  /// Of a cell, or of a part of it that has these of its points, one at least.
  Range of(vtkIdType cell, const vtkIdType* points, vtkIdType count) const
  {
    if (this->Colors.colorCoordinates)
    {
      return this->between(points, count);
    }
    Range range{ true, true };
    const auto add = [&](vtkIdType color)
    {
      const unsigned char alpha = this->Colors.colors[4 * color + 3];
      range.opaque = range.opaque && alpha == 255;
      range.invisible = range.invisible && alpha == 0;
      range.mean += alpha / 255.0;
    };
    if (!this->Colors.colors || this->Colors.colorAssociation == Association::Leaf)
    {
      return { true, false, 1.0 };
    }
    if (this->Colors.colorAssociation == Association::Cell)
    {
      add(cell);
      return range;
    }
    std::for_each(points, points + count, add);
    range.mean /= static_cast<double>(count);
    return range;
  }

private:
  /// Of all texels between those of the points.
  Range between(const vtkIdType* points, vtkIdType count) const
  {
    const int size = this->Colors.colorTextureSize;
    int first = size, last = -1;
    bool none = false; // a point has no value
    double sum = 0.0;
    for (vtkIdType i = 0; i < count; ++i)
    {
      const int texel = detail::texelAt(
        this->Colors, detail::coordinatesAt(this->Colors, static_cast<std::size_t>(points[i])));
      sum += this->Colors.colorTexture[4 * texel + 3] / 255.0;
      none = none || texel >= size;
      first = texel < size ? std::min(first, texel) : first;
      last = texel < size ? std::max(last, texel) : last;
    }
    Range range{ true, true };
    if (none)
    {
      const unsigned char alpha = this->Colors.colorTexture[4 * size + 3];
      range = { alpha == 255, alpha == 0 };
    }
    range.mean = sum / static_cast<double>(count);
    if (first <= last)
    {
      range.opaque = range.opaque && this->Clear[last + 1] == this->Clear[first];
      range.invisible = range.invisible && this->Visible[last + 1] == this->Visible[first];
    }
    return range;
  }

  const Attributes& Colors;
  std::vector<int> Clear{ 0 }, Visible{ 0 }; // such texels among the first i
};
}

#endif
