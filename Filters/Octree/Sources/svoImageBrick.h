// The surface in the voxels of a brick that are no larger than the cells of an image.
//
// A trilinear field has its extremes in a part of a cell at the part's corners. So values at the
// corners of voxels, and where the borders of cells cut voxels, say for certain whether the surface
// passes through a voxel, as in marching cubes: some are below the value and some are not. And
// where the field takes the value on the edges between such corners, neighbouring voxels have the
// same points: planes through the middle of a voxel's points meet those of its neighbours closely.
#ifndef svoImageBrick_h
#define svoImageBrick_h

#include <cstdint>

#include <glm/vec3.hpp>

namespace svo
{
class GriddedField;
struct ImageGrid;
struct SourceBrick;

class ImageBrick
{
public:
  /// Only where ready(): voxels are no larger than cells.
  ImageBrick(const ImageGrid& grid, const SourceBrick& brick);
  static bool ready(const ImageGrid& grid, double half);

  /// Reads what the field has there. False if all is on one side of all surfaces, whose values are
  /// from `lowest` to `highest`.
  bool read(const GriddedField& field, double lowest, double highest);

  /// The voxels that the surface of a value passes through, without those that have a corner
  /// without a finite value.
  std::uint64_t passedBy(double surface) const;

  /// Of a voxel that the surface of a value passes: the mean of where it crosses edges, in voxels
  /// from the brick's corner; and from which side of the voxel to which values rise, of any length.
  void crossings(double surface, int voxel, glm::dvec3& middle, glm::dvec3& rise) const;

private:
  static constexpr int Positions = 9; // along an axis: five borders of voxels, cells' between them
  static constexpr int Points = 6;    // of the image

  struct Axis
  {
    int count = 0;
    int border[5];        // of voxels: their positions
    double at[Positions]; // in voxels from the brick's corner
    int point[Positions]; // the point of the image at or below it, from `first` on
    double in[Positions]; // how far beyond that
    int first = 0, last = 0;
  };
  static Axis axisOf(double begin, double step, int last);

  Axis Axes[3];
  double Values[Positions][Positions][Positions];
};
}

#endif
