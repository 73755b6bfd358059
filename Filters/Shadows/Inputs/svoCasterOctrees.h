// The octrees of casters: those that they carry, and others, which are built and kept.
#ifndef svoCasterOctrees_h
#define svoCasterOctrees_h

#include "svoOctree.h"

#include "vtkNew.h"

#include <string>
#include <vector>

class vtkAlgorithm;
class vtkObject;
class vtkPolyData;
class vtkPolyDataToSVO;

namespace svo
{
class CasterOctrees
{
public:
  /// `owner` is told of the progress, and asked whether to go on.
  explicit CasterOctrees(vtkAlgorithm* owner);
  ~CasterOctrees();
  CasterOctrees(const CasterOctrees&) = delete;
  void operator=(const CasterOctrees&) = delete;

  /// Of a mesh: the octree that it carries, whatever its level and leaves, else one with exact
  /// leaves of at most `level` levels. `problem`: a sentence about why there is none, where the
  /// octree is empty and the build was not aborted, or about what is not in it. The owner's
  /// progress goes from `begin` to `end`.
  Octree octreeOf(vtkPolyData* mesh, int level, double begin, double end, std::string& problem);

private:
  void onEvent(vtkObject*, unsigned long event, void* data);
  vtkAlgorithm* Owner;
  vtkNew<vtkPolyDataToSVO> Converter; // keeps what it builds
  std::vector<std::string> Problems;
  double Begin = 0.0, End = 0.0;
};
}

#endif
