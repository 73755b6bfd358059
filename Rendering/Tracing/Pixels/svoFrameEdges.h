// The edges of a frame as it is shown.
#ifndef svoFrameEdges_h
#define svoFrameEdges_h

#include "svoDepthBuffer.h"
#include "svoEdges.h"
#include "svoFrame.h"
#include "svoView.h"
#include "svoWorldSize.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace svo
{
/// A pixel's width in window depth. With z = a + b / t and a pixel's width proportional to
/// t it is affine in z, in a parallel view constant.
struct PixelDepth
{
  explicit PixelDepth(const View& view)
  {
    const double first = view.parallel ? 1.0 : view.tNear;
    const double t[2] = { first, 2.0 * first };
    double z[2], width[2];
    for (int i = 0; i < 2; ++i)
    {
      z[i] = view.windowDepth(t[i]);
      // The derivative of the window depth, from a difference that is exact for 1 / t.
      const double step = view.windowDepth(2.0 * t[i]) - z[i];
      width[i] = worldPixel(view, t[i]) * std::abs(step) * (view.parallel ? 1.0 : 2.0) / t[i];
    }
    this->slope = z[1] != z[0] ? static_cast<float>((width[1] - width[0]) / (z[1] - z[0])) : 0.0f;
    this->constant = static_cast<float>(width[0] - this->slope * z[0]);
  }
  float operator()(float window) const { return this->constant + this->slope * window; }

  float constant = 0.0f;
  float slope = 0.0f;
};

class FrameEdges
{
public:
  /// `seen`: what the frame shows.
  FrameEdges(const Frame& frame, const DepthBuffer& seen, const View& view)
    : Picture(frame)
    , Seen(seen)
    , Columns(view.width)
    , Rows(view.height)
    , Width(view)
  {
  }

  std::uint32_t instance(int x, int y) const
  {
    return x >= 0 && y >= 0 && x < this->Columns && y < this->Rows ? this->Seen.instanceAt(x, y)
                                                                   : NoInstance;
  }

  /// The pixels of a tile, and those around it, as isEdge() asks for them.
  class Tile
  {
  public:
    Tile(const FrameEdges& edges, int tileX, int tileY)
      : Edges(edges)
      , X0(8 * tileX - 1)
      , Y0(8 * tileY - 1)
    {
      for (int row = 0; row < Size; ++row)
      {
        for (int column = 0; column < Size; ++column)
        {
          const int x = this->X0 + column, y = this->Y0 + row;
          const std::uint32_t seen = edges.instance(x, y);
          this->Instances[Size * row + column] = seen;
          this->Primitives[Size * row + column] =
            seen != NoInstance ? edges.Seen.primitive[edges.Seen.at(x, y)] : NoPrimitive;
        }
      }
    }
    std::uint32_t instance(int x, int y) const { return this->Instances[this->at(x, y)]; }
    bool changes(int x, int y) const
    {
      const std::size_t pixel = this->Edges.at(x, y);
      const Primitive* const own = this->Primitives + this->at(x, y);
      // How many of the four pixels beside this one show its primitive.
      const int same =
        (own[-1] == *own) + (own[1] == *own) + (own[-Size] == *own) + (own[Size] == *own);
      return this->Edges.steps(pixel) ||
        (same < 4 && (this->Edges.bends(pixel) || (same > 0 && this->Edges.creases(pixel))));
    }

  private:
    static constexpr int Size = 10;
    int at(int x, int y) const { return Size * (y - this->Y0) + x - this->X0; }

    const FrameEdges& Edges;
    int X0, Y0;
    std::uint32_t Instances[Size * Size];
    Primitive Primitives[Size * Size];
  };

  /// Of a pixel in window depth, where the window depth is `depth`.
  float width(float depth) const { return this->Width(depth); }

private:
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * this->Columns + x; }

  bool steps(std::size_t pixel, float pixels = 1.0f) const
  {
    const float* depth = this->Picture.depth.data() + pixel;
    const std::ptrdiff_t up = this->Columns;
    const float width = pixels * this->Width(*depth);
    return depthSteps(depth[-1], *depth, depth[1], width) ||
      depthSteps(depth[-up], *depth, depth[up], width);
  }

  /// True if facets meet at more than a few degrees, so that the samples on one of them lie off the
  /// plane of the other. Of facets that are no larger than pixels one is as good as the next.
  bool creases(std::size_t pixel) const { return this->steps(pixel, 0.02f); }

  /// True if the colour bends more than its rounding does.
  bool bends(std::size_t pixel) const
  {
    constexpr int Most = 4; // grey levels
    const std::ptrdiff_t up = this->Columns;
    const std::uint8_t* color = this->Picture.color.data() + 4 * pixel;
    const auto bends = [&](std::ptrdiff_t away)
    {
      return std::abs(color[-away] - 2 * color[0] + color[away]) > Most ||
        std::abs(color[1 - away] - 2 * color[1] + color[1 + away]) > Most ||
        std::abs(color[2 - away] - 2 * color[2] + color[2 + away]) > Most;
    };
    return bends(4) || bends(4 * up);
  }

  const Frame& Picture;
  const DepthBuffer& Seen;
  int Columns, Rows;
  PixelDepth Width;
};
}

#endif
