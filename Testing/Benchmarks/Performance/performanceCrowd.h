// The scenes of many objects that BenchmarkCrowd draws.
//
// field   objects of `triangles` (20 000), four meshes, strewn over a square ground as wide as the
//         view, whatever their number; the eye stands in front of it, a little higher than they
//         are, so that most are tiny
// plain   the same seen from high above, so that few are
// small   objects of 480 triangles in a grid on a ground
// inside  the same from among them: most lie outside of the view
// layers  100 objects of 20 000 triangles in `complexity` layers behind each other, each of which
//         fills the view but for a tenth
// glyphs  copies of a sphere of 1000 triangles by one vtkGlyph3DMapper, in a grid on a ground;
//         beside it the window with nothing in it
#ifndef performanceCrowd_h
#define performanceCrowd_h

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace performance
{
struct CrowdOptions
{
  std::string scene = "field";
  int complexity = 8, triangles = 20000;
};

class Crowd
{
public:
  /// Adds the scene and its light to a renderer, which outlives this, and aims its camera.
  Crowd(vtkRenderer* renderer, const CrowdOptions& options, int objects);
  /// Actors that are there.
  int actors() const;
  /// The camera of frame k.
  void aim(int k);
  /// Every object turns and bobs; of copies, the points that they are at bob.
  void move();

private:
  vtkActor* add(vtkPolyDataMapper* mapper, std::mt19937& random);
  void addLayers();
  void addObjects(int objects, int side);
  void addCopies(int objects, int side);
  void addGround();
  vtkSmartPointer<vtkPolyDataMapper> mapperOf(int kind, int triangles);

  vtkRenderer* const Renderer;
  const CrowdOptions Asked;
  std::vector<vtkSmartPointer<vtkActor>> Actors;
  vtkNew<vtkPolyData> Places; // of copies
  std::size_t Moves = 0;
  double Half = 10.0; // of the edge of the square that they stand on
};
}

#endif
