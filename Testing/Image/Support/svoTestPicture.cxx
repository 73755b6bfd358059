// Reading and comparing pictures of a render window.
#include "svoTestPicture.h"

#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

namespace svotest
{
double Picture::grey(std::size_t pixel) const
{
  return (this->rgb[3 * pixel] + this->rgb[3 * pixel + 1] + this->rgb[3 * pixel + 2]) / 3.0;
}

Picture capture(vtkRenderWindow* window)
{
  window->Render();
  Picture picture;
  picture.width = window->GetSize()[0];
  picture.height = window->GetSize()[1];
  vtkNew<vtkUnsignedCharArray> rgb;
  window->GetPixelData(0, 0, picture.width - 1, picture.height - 1, 1, rgb);
  picture.rgb.assign(rgb->GetPointer(0), rgb->GetPointer(0) + rgb->GetNumberOfValues());
  vtkNew<vtkFloatArray> depth;
  window->GetZbufferData(0, 0, picture.width - 1, picture.height - 1, depth);
  picture.depth.assign(depth->GetPointer(0), depth->GetPointer(0) + depth->GetNumberOfValues());
  return picture;
}

namespace
{
// The window depth of a plane is linear over the screen: what deviates is an edge.
bool isEdge(const Picture& p, int x, int y)
{
  auto depth = [&](int i, int j) { return p.depth[static_cast<std::size_t>(j) * p.width + i]; };
  if (x < 1 || y < 1 || x + 1 >= p.width || y + 1 >= p.height)
  {
    return true;
  }
  const float here = depth(x, y);
  for (auto [dx, dy] : { std::pair{ 1, 0 }, { 0, 1 }, { 1, 1 }, { 1, -1 } })
  {
    const float before = depth(x - dx, y - dy);
    const float after = depth(x + dx, y + dy);
    if ((before == 1.0f) != (here == 1.0f) || (after == 1.0f) != (here == 1.0f))
    {
      return true;
    }
    const float bend = std::abs(before - 2.0f * here + after);
    const float slope = std::abs(after - before);
    if (bend > 1e-5f + 0.3f * slope)
    {
      return true;
    }
  }
  return false;
}
}

Mask awayFromEdges(const Picture& picture, int radius)
{
  Mask mask(picture.size(), 1);
  for (int y = 0; y < picture.height; ++y)
  {
    for (int x = 0; x < picture.width; ++x)
    {
      if (!isEdge(picture, x, y))
      {
        continue;
      }
      for (int j = std::max(0, y - radius); j <= std::min(picture.height - 1, y + radius); ++j)
      {
        for (int i = std::max(0, x - radius); i <= std::min(picture.width - 1, x + radius); ++i)
        {
          mask[static_cast<std::size_t>(j) * picture.width + i] = 0;
        }
      }
    }
  }
  return mask;
}

Difference difference(const Picture& a, const Picture& b, const Mask& mask)
{
  Difference result;
  std::vector<int> worst;
  double sum = 0.0;
  for (std::size_t pixel = 0; pixel < a.size(); ++pixel)
  {
    if (!mask[pixel])
    {
      continue;
    }
    int largest = 0;
    for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c)
    {
      const int d = std::abs(static_cast<int>(a.rgb[c]) - static_cast<int>(b.rgb[c]));
      largest = std::max(largest, d);
      sum += d;
    }
    worst.push_back(largest);
  }
  result.pixels = worst.size();
  if (!worst.empty())
  {
    std::sort(worst.begin(), worst.end());
    result.mean = sum / (3.0 * worst.size());
    result.p99 = worst[(worst.size() - 1) * 99 / 100];
    result.largest = worst.back();
  }
  return result;
}

Difference difference(const Picture& a, const Picture& b)
{
  return difference(a, b, Mask(a.size(), 1));
}

void Checks::expect(bool holds, const std::string& sentence)
{
  if (!holds)
  {
    ++this->failures;
    std::cerr << "Does not hold: " << sentence << "\n";
  }
}

int Checks::exitCode() const
{
  return this->failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

std::size_t differing(const Picture& a, const Picture& b)
{
  constexpr int Lit = 24; // of 255
  std::size_t count = 0;
  for (std::size_t i = 0; i + 2 < a.rgb.size(); i += 3)
  {
    int most = 0;
    for (std::size_t k = i; k < i + 3; ++k)
    {
      most = std::max(most, std::abs(int(a.rgb[k]) - int(b.rgb[k])));
    }
    count += most > Lit;
  }
  return count;
}
}
