// The octrees that a filter builds in the background.
#ifndef svoOctreeJobs_h
#define svoOctreeJobs_h

#include "svoBackgroundBuild.h"
#include "svoOctreeCache.h"

#include <list>

class vtkPolyData;

namespace svo
{
/// Not thread-safe: a filter's own.
class OctreeJobs
{
public:
  using Key = OctreeCache::Key;
  using Result = BackgroundBuild::Result;

  /// True, with the result, if the octree is there; that is the end of its job. Else a job is begun
  /// if `mayBegin` and there are not too many at work.
  bool ask(const Key& key, vtkPolyData* mesh, const MeshOctreeOptions& options, bool mayBegin,
    Result& result);

  /// Waits for the octree's job if there is one, else builds. The result is Aborted if
  /// options.progress breaks off.
  void wait(const Key& key, vtkPolyData* mesh, const MeshOctreeOptions& options, Result& result);

  /// To be called after each execution: jobs that it did not ask for are abandoned.
  void endExecution();

  /// Jobs whose result nobody has had yet.
  int count() const;

private:
  /// Each of them uses all processors where it can.
  static constexpr int MostAtWork = 4;

  struct Job
  {
    Job(const Key& itsKey, vtkPolyData* mesh, const MeshOctreeOptions& options)
      : key(itsKey)
      , build(mesh, options)
    {
    }
    Key key;
    BackgroundBuild build;
    bool asked = true; // by the execution that is under way
  };

  std::list<Job>::iterator find(const Key& key);

  std::list<Job> Jobs;
};
}

#endif
