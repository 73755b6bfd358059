// The ball and the rod that shapes are copies of, with their octrees.
#ifndef svoUnitShapes_h
#define svoUnitShapes_h

#include "svoRoundShapes.h"

#include "vtkSmartPointer.h"

#include <map>
#include <memory>
#include <utility>

class vtkPolyData;

namespace svo
{
/// Used by one thread.
class UnitShapes
{
public:
  /// Those that all have who have any.
  static std::shared_ptr<UnitShapes> ofAll();

  /// Ball: radius 1, around 0. Rod: radius 1, along z from 0 to 1, closed at both ends. All of
  /// their points lie on the true shape, so flat facets lie inside of it, and what VTK draws as a
  /// true ball or tube is never inside of its own caster. The octree is in the mesh's field data,
  /// so that nothing is built for any frame.
  vtkPolyData* of(const RoundShapes& shapes);

  /// Facets around, 8 to 64: so many that they lie no more than a tenth of a pixel inside, if the
  /// shapes have a width in pixels; else the most, 0.12 % of the radius. Of thousands of balls each
  /// has fewer, 16 at least, 1.9 %: they are small, and rays to a light go through all of
  /// their triangles; its maps meet balls themselves (Body::ball).
  static int facetsOf(const RoundShapes& shapes);

private:
  std::map<std::pair<RoundShapes::Shape, int>, vtkSmartPointer<vtkPolyData>> Meshes; // and facets
};
}

#endif
