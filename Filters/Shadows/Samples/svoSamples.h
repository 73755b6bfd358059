// Points that ask whether light reaches them, in pieces that lie close together.
#ifndef svoSamples_h
#define svoSamples_h

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
struct Sample
{
  glm::dvec3 position; // world
  glm::dvec3 normal;   // world, unit, to the outside; 0 where there is no surface
  std::uint32_t own;   // the triangle, or the mesh's point, that it lies on
  std::uint32_t place; // which of the piece's places it belongs to
  double share;        // of its place
};

/// Places (cells or points of a mesh), cut into pieces that can be asked for on their own and in
/// any order.
class Samples
{
public:
  virtual ~Samples() = default;
  /// How many places have samples.
  virtual std::size_t placeCount() const = 0;
  virtual std::size_t pieces() const = 0;
  /// The ids of the places of a piece, in the order of Sample::place, and their samples. Both
  /// arrays are overwritten. May be called by several threads.
  virtual void piece(
    std::size_t index, std::vector<std::uint32_t>& places, std::vector<Sample>& samples) const = 0;
};

/// About so many samples are a piece: as many as go to a light together.
constexpr std::size_t PieceSamples = 64;
}

#endif
