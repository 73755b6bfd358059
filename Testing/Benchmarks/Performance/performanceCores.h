// What a frame would take on other numbers of cores than there are: its loops are run chunk by
// chunk on one, and the chunks' times are then given to cores one after the other, each to the core
// that is idle first, as threads take them (list scheduling: Graham, "Bounds for certain
// multiprocessing anomalies", 1966). What cores do to each other, through memory and clock rates,
// is left out.
#ifndef performanceCores_h
#define performanceCores_h

#include "svoParallel.h"

#include <vector>

namespace performance
{
class RecordedLoops
{
public:
  /// Forgets what was recorded, and begins anew.
  void begin();
  /// Runs loops and records them; to be used while this lives.
  svo::ParallelFor loops();

  /// Milliseconds since begin().
  double now() const;

  /// Milliseconds that what was recorded between two moments, whole loops, takes on `cores`.
  /// Threads start one after the other, which takes `launch` each.
  double time(double first, double last, int cores, double launch) const;
  /// Those of it that are in no loop.
  double serial(double first, double last) const;

  /// Milliseconds that it takes here to start a thread.
  static double launch();

private:
  struct Loop
  {
    double begin, end;
    std::vector<double> chunks;
  };
  std::vector<Loop> Loops;
  bool Inside = false; // a loop; those in it are part of its chunks
  double Start = 0.0;
};
}

#endif
