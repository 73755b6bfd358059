// Where a vtkGlyph3DMapper puts the copies of its sources.
#ifndef svoGlyphPlaces_h
#define svoGlyphPlaces_h

#include "svoSurfaceLook.h"

#include "vtkQuaternion.h"
#include "vtkType.h"

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

class vtkAbstractArray;
class vtkDataArray;
class vtkDataSet;
class vtkGlyph3DMapper;

namespace svo
{
/// True of an array that has no value for some of the points.
bool isTooShort(vtkAbstractArray* array, vtkIdType points);

/// By a mapper's settings and an input's arrays, as vtkOpenGLGlyph3DMapper::RebuildStructures has
/// it.
class GlyphPlaces
{
public:
  GlyphPlaces(vtkGlyph3DMapper* mapper, vtkDataSet* input);

  /// Why the mapper draws nothing, or nothing certain; null if all is well.
  Reason fault() const;

  /// The copy at a point: source -> input. False if it cannot be seen: nowhere, or a point itself.
  /// `condition` is raised to that of the matrix, in the Frobenius norm.
  bool at(vtkIdType point, glm::dmat4x3& place, double& condition) const;

private:
  vtkQuaterniond turnOf(vtkIdType point) const;
  glm::dvec3 scaleOf(vtkIdType point) const;

  vtkDataSet* Input;
  vtkDataArray* Scales;
  vtkDataArray* Orientations;
  int ScaleMode, OrientationMode;
  bool Scaling, Clamping;
  double Factor, Low, High;
};
}

#endif
