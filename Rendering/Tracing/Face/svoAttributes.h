// Arrays of a mesh that its look needs, and the values in them.
#ifndef svoAttributes_h
#define svoAttributes_h

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// The element of the mesh, or of its octree, that an array has one value for.
enum class Association
{
  None,
  Point,
  Cell,
  Leaf // the voxel, of an octree of planes
};

/// Arrays of the mesh that the look needs. Null where there are none.
struct Attributes
{
  const float* normals = nullptr; // 3 components, local coordinates, one per `normalAssociation`
  Association normalAssociation = Association::None;
  const unsigned char* colors = nullptr; // RGBA, mapped through the lookup table
  Association colorAssociation = Association::None;
  /// Scalars interpolated before mapping: two coordinates per point into two rows of texels, one of
  /// colours and above it one of the colour of NaN. The nearest texel counts, as in VTK's texture.
  const float* colorCoordinates = nullptr;
  const unsigned char* colorTexture = nullptr; // RGBA
  int colorTextureSize = 0;                    // texels of a row
  /// Other than before where one of the arrays has other values than before, at the same address.
  std::uint64_t version = 0;
};

/// The mesh's own points, local coordinates, in the type that the mesh has them in. Neither:
/// unknown.
struct MeshPoints
{
  const float* floats = nullptr;
  const double* doubles = nullptr;
  std::size_t count = 0;

  explicit operator bool() const { return this->floats || this->doubles; }
  glm::dvec3 at(std::size_t i) const
  {
    return this->doubles
      ? glm::dvec3(this->doubles[3 * i], this->doubles[3 * i + 1], this->doubles[3 * i + 2])
      : glm::dvec3(this->floats[3 * i], this->floats[3 * i + 1], this->floats[3 * i + 2]);
  }
};

namespace detail
{
inline glm::vec3 vectorAt(const float* array, std::size_t i)
{
  return { array[3 * i], array[3 * i + 1], array[3 * i + 2] };
}

inline glm::vec3 colorAt(const unsigned char* array, std::size_t i)
{
  return glm::vec3(array[4 * i], array[4 * i + 1], array[4 * i + 2]) / 255.0f;
}

/// Texture coordinates of a point.
inline glm::vec2 coordinatesAt(const Attributes& a, std::size_t i)
{
  return { a.colorCoordinates[2 * i], a.colorCoordinates[2 * i + 1] };
}

/// The texel that VTK's texture, clamped to its edge and not interpolated, shows at `at`.
inline int texelAt(const Attributes& a, const glm::vec2& at)
{
  const float x =
    at.x > 0.0f ? std::min(at.x, 1.0f) * static_cast<float>(a.colorTextureSize) : 0.0f;
  const int texel = std::min(static_cast<int>(x), a.colorTextureSize - 1);
  return at.y < 0.5f ? texel : texel + a.colorTextureSize;
}
}
}

#endif
