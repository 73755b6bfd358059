// What a group of 4x4 tiles makes of an instance's octree coordinates: pixels and depth as linear
// functions, and how far all that is computed from them can be off.
#ifndef svoGroupView_h
#define svoGroupView_h

#include <glm/vec4.hpp>

namespace svo
{
/// Functions f(v) = f.x v.x + f.y v.y + f.z v.z + f.w of octree coordinates minus 1, in which
/// points of the cube lie in [0, 1]. Pixels are counted from the middle of the group.
struct GroupView
{
  static constexpr int Tiles = 4;          // along an edge of the group
  static constexpr int Pixels = 8 * Tiles; // likewise

  glm::vec4 x, y, w; // a point is seen at the pixel (x / w, y / w)
  glm::vec4 k;       // its key is scale k / w: it grows with the depth
  float scale;
  float kOfT[2], wOfT[2]; // k and w where a ray's t is so much: f[0] t + f[1]

  /// How far a corner of a triangle can be from where it is computed, times w: `error`, and
  /// `errorFar` more for each pixel of its distance from the middle.
  float error, errorFar;
  float rounding;    // and by how much for each pixel of that distance, once w is divided by
  float depthError;  // how far depths of corners can be off
  float apart;       // how far depths of hits have to be apart to be told apart, besides
  float leastW;      // of points whose w is known to a 16th
  float beforeRays;  // rays begin behind all points with a lesser w
  float farW;        // w of where rays end
  float kNear, kFar; // keys of where rays begin and end
  /// Hits whose depth may be off by more than `reach` are doubtful, and named where it may be more
  /// than `nearReach`.
  float nearReach, reach;
  /// Nodes that begin further behind what is met for certain hold nothing that could be met first.
  float behind;
};
}

#endif
