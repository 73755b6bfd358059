// What the paper's experiments show: how many objects, where they stand, from where they are seen.
#ifndef PaperScenes_experiments_h
#define PaperScenes_experiments_h

#include <string>
#include <vector>

namespace paper
{
/// World coordinates: the ground is z = 0, z up; object A is 1 high at size 1.
struct Viewpoint
{
  const char* name;
  double position[3];
  double focalPoint[3];
  double viewAngle; ///< vertical, degrees
};

struct Placement
{
  double x;
  double y;
  double heading; ///< degrees about z
  double size;
};

/// B walks counterclockwise around a circle; a size of 0 means there is no B.
struct Walk
{
  double center[2];
  double radius;
  double start; ///< degrees about z
  double size;
  double pace; ///< 1: as fast as the feet say; less: on the spot, as on a treadmill
};

struct Experiment
{
  std::string name;
  std::string objects;
  /// The first A spins, the others stand still.
  std::vector<Placement> a;
  Walk b;
  /// The timed ones. The objects cover at least 30 % of the pixels, on average over the animation.
  std::vector<Viewpoint> views;
  double light[3];
  /// Frames per second, as the paper's table 2 gives them: a range.
  std::string paperFramesPerSecond;
  /// Further ones, for the movie only: a slim figure fills 30 % of a wide picture in close-ups
  /// alone.
  std::vector<Viewpoint> wideViews;

  const std::vector<Viewpoint>& shownViews() const
  {
    return this->wideViews.empty() ? this->views : this->wideViews;
  }
};

/// paper1a, paper1b, paper2, paper3, paper4.
const std::vector<Experiment>& experiments();
}

#endif
