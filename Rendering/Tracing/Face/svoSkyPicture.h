// The picture of a sky: an equirectangular one, as a table from which directions are drawn as often
// as light comes from them.
//
// The table has cells of equal longitudes and latitudes. A sample falls into a row, and then into a
// cell of it, by the sums of their light (Pharr, Jakob and Humphreys, "Physically Based Rendering",
// 2016, 14.2.4); inside of a cell directions are spread evenly. So bright cells have many samples
// and dark ones few, and none counts more than brightest(). What arrives on an open plane is a
// polynomial of the second degree in its normal (Ramamoorthi and Hanrahan, "An Efficient
// Representation for Irradiance Environment Maps", 2001): nearly exact of skies, off by up to a
// tenth of what a small sun gives that faces it.
#ifndef svoSkyPicture_h
#define svoSkyPicture_h

#include "vtkSVOTracingModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace svo
{
class VTKSVOTRACING_EXPORT SkyPicture
{
public:
  /// Larger pictures are averaged.
  static constexpr int MostColumns = 128, MostRows = 64;

  /// Colours of `columns` by `rows` pixels, linear, row by row from below; what is negative or
  /// not a number counts as 0. `axes`: unit vectors of the world: to the middle of the picture,
  /// upwards, and to the middle of its right half.
  SkyPicture(int columns, int rows, const float* rgb, const glm::mat3& axes);

  /// Another one for each picture.
  std::uint64_t version() const { return this->Version; }

  /// A direction, unit, for a point of the unit square.
  glm::vec3 direction(const glm::vec2& square) const;
  /// What a sample of that direction counts on a plane (unit normal), of brightest().
  glm::vec3 share(const glm::vec3& direction, const glm::vec3& normal) const;
  /// Pi times the radiance that a sample stands for, at most.
  float brightest() const { return this->Brightest; }
  /// What arrives on an open plane: pi times the mean radiance by the cosine.
  glm::vec3 over(const glm::vec3& normal) const;

  // As shaders have them:
  int columns() const { return this->Columns; }
  int rows() const { return this->Rows; }
  /// Sums of the rows' light before each, and at the end, 0..1; of each row those of its cells; and
  /// of each cell its colour by its largest part, red, green and blue.
  const std::vector<float>& table() const { return this->Table; }
  const glm::mat3& axes() const { return this->Axes; }
  /// Of 1, x, y, z, xy, yz, 3zz - 1, xz, xx - yy, along the axes.
  const glm::vec3* irradiance() const { return this->Irradiance; }

private:
  const float* rowEnds() const { return this->Table.data(); }
  const float* cellEnds(int row) const
  {
    return this->Table.data() + this->Rows + 1 + row * (this->Columns + 1);
  }
  std::size_t colorAt(int row, int column) const
  {
    return static_cast<std::size_t>(
      this->Rows + 1 + this->Rows * (this->Columns + 1) + 3 * (row * this->Columns + column));
  }

  int Columns, Rows;
  std::vector<float> Table;
  float Brightest = 0.0f;
  glm::mat3 Axes;
  glm::vec3 Irradiance[9];
  std::uint64_t Version;
};
}

#endif
