// Pictures of a render window and their comparison, for the image tests.
#ifndef svoTestPicture_h
#define svoTestPicture_h

#include <cstddef>
#include <string>
#include <vector>

class vtkRenderWindow;

namespace svotest
{
/// What a window shows: rows from the bottom, as VTK has them.
struct Picture
{
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgb; // 3 a pixel
  std::vector<float> depth;       // 0..1, 1 where nothing was drawn

  std::size_t size() const { return static_cast<std::size_t>(width) * height; }
  /// Mean of the three channels, 0..255.
  double grey(std::size_t pixel) const;
  double grey(int x, int y) const { return this->grey(static_cast<std::size_t>(y) * width + x); }
};

/// Renders once and reads the result.
Picture capture(vtkRenderWindow* window);

/// One flag a pixel.
using Mask = std::vector<unsigned char>;

/// Pixels at least `radius` pixels away from any jump: a neighbour that was not drawn, or whose
/// depth is not on the plane through the pixels around it.
Mask awayFromEdges(const Picture& picture, int radius);

/// Largest channel difference of each pixel in the mask.
struct Difference
{
  std::size_t pixels = 0;
  double mean = 0.0; // mean absolute difference of channels, 0..255
  int p99 = 0;       // 99th percentile of the largest channel difference
  int largest = 0;
};
Difference difference(const Picture& a, const Picture& b, const Mask& mask);
Difference difference(const Picture& a, const Picture& b);

/// Collects what a test expects; the exit code says whether all of it held.
class Checks
{
public:
  /// Prints the sentence when it does not hold.
  void expect(bool holds, const std::string& sentence);
  int exitCode() const;

private:
  int failures = 0;
};

/// Pixels in which the two differ as light and shadow do: by far.
std::size_t differing(const Picture& a, const Picture& b);
}

#endif
