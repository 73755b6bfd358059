// What the eye sees of surfaces whose front faces are culled, as meshes that cast.
#ifndef svoSeenFaces_h
#define svoSeenFaces_h

#include "svoKeepAlive.h"
#include "svoView.h"

#include "vtkSmartPointer.h"

#include <utility>
#include <vector>

#include <glm/mat4x4.hpp>

class vtkActor;
class vtkPolyData;

namespace svo
{
struct FacesLeft
{
  std::vector<bool> culled;
  vtkSmartPointer<vtkPolyData> made; // without these
};
/// Kept until the mesh changes, or another of its polygons turns to the eye, or nobody has them.
using SeenFaces = CachedValues<std::pair<vtkPolyData*, vtkActor*>, FacesLeft>;

/// A mesh of an actor without the polygons that turn their front to the eye, in whose places are
/// cells without an area; strips, and surfaces that are no meshes, stay whole. The mesh itself if
/// no polygon does; null if all do.
vtkPolyData* seenFacesOf(vtkPolyData* mesh, vtkActor* actor, const glm::dmat4& localToWorld,
  const View& eye, SeenFaces& faces, KeepAlive& kept);
}

#endif
