#include "svoGlyphPlaces.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkGlyph3DMapper.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace svo
{
namespace
{
/// The mapper tells its subclasses only which arrays it reads.
struct Asking : public vtkGlyph3DMapper
{
  using vtkGlyph3DMapper::GetOrientationArray;
  using vtkGlyph3DMapper::GetScaleArray;
};
}

bool isTooShort(vtkAbstractArray* array, vtkIdType points)
{
  return array && array->GetNumberOfTuples() < points;
}

GlyphPlaces::GlyphPlaces(vtkGlyph3DMapper* mapper, vtkDataSet* input)
  : Input(input)
  , Scales((mapper->*(&Asking::GetScaleArray))(input))
  , Orientations((mapper->*(&Asking::GetOrientationArray))(input))
  , ScaleMode(mapper->GetScaleMode())
  , OrientationMode(mapper->GetOrientationMode())
  , Scaling(mapper->GetScaling())
  , Clamping(mapper->GetClamping() && this->ScaleMode != vtkGlyph3DMapper::NO_DATA_SCALING)
  , Factor(mapper->GetScaleFactor())
  , Low(mapper->GetRange()[0])
  , High(mapper->GetRange()[1])
{
}

Reason GlyphPlaces::fault() const
{
  const int components = this->Orientations ? this->Orientations->GetNumberOfComponents() : 0;
  const int wanted = this->OrientationMode == vtkGlyph3DMapper::QUATERNION ? 4 : 3;
  if (this->Orientations && components != wanted)
  {
    return "has orientations with the wrong number of components";
  }
  const vtkIdType points = this->Input->GetNumberOfPoints();
  return isTooShort(this->Orientations, points) || isTooShort(this->Scales, points)
    ? "has arrays with fewer values than points"
    : nullptr;
}

vtkQuaterniond GlyphPlaces::turnOf(vtkIdType point) const
{
  double o[4] = { 0.0, 0.0, 0.0, 0.0 };
  this->Orientations->GetTuple(point, o);
  switch (this->OrientationMode)
  {
    case vtkGlyph3DMapper::ROTATION:
    {
      const auto about = [](int axis, double degrees)
      {
        const double half = 0.5 * vtkMath::RadiansFromDegrees(degrees);
        vtkQuaterniond turn(std::cos(half), 0.0, 0.0, 0.0);
        turn[axis] = std::sin(half);
        return turn;
      };
      return about(3, o[2]) * about(1, o[0]) * about(2, o[1]);
    }
    case vtkGlyph3DMapper::QUATERNION:
      return vtkQuaterniond(o);
    default:
      break;
  }
  if (o[1] == 0.0 && o[2] == 0.0)
  {
    return o[0] < 0.0 ? vtkQuaterniond(0.0, 0.0, 1.0, 0.0) : vtkQuaterniond();
  }
  // Half a turn about what is halfway between the x axis and the direction.
  const glm::dvec3 direction(o[0], o[1], o[2]);
  const glm::dvec3 axis =
    glm::normalize(0.5 * (direction + glm::dvec3(glm::length(direction), 0.0, 0.0)));
  return vtkQuaterniond(0.0, axis.x, axis.y, axis.z);
}

glm::dvec3 GlyphPlaces::scaleOf(vtkIdType point) const
{
  glm::dvec3 scale(1.0);
  if (this->Scales)
  {
    const int components = this->Scales->GetNumberOfComponents();
    if (this->ScaleMode == vtkGlyph3DMapper::SCALE_BY_MAGNITUDE)
    {
      scale = glm::dvec3(vtkMath::Norm(this->Scales->GetTuple(point), components));
    }
    else if (this->ScaleMode == vtkGlyph3DMapper::SCALE_BY_COMPONENTS && components == 3)
    {
      this->Scales->GetTuple(point, &scale.x);
    }
    if (this->Clamping)
    {
      const double length = this->High - this->Low;
      for (int i = 0; i < 3; ++i)
      {
        const double clamped = scale[i] < this->Low ? this->Low
          : scale[i] > this->High                   ? this->High
                                                    : scale[i];
        scale[i] = (clamped - this->Low) / (length == 0.0 ? 1.0 : length);
      }
    }
  }
  scale *= this->Factor;
  for (int i = 0; i < 3; ++i)
  {
    scale[i] = scale[i] == 0.0 ? 1e-10 : scale[i]; // so the mapper does
  }
  return scale;
}

bool GlyphPlaces::at(vtkIdType point, glm::dmat4x3& place, double& condition) const
{
  glm::dmat3 turn(1.0);
  if (this->Orientations)
  {
    double matrix[3][3];
    this->turnOf(point).ToMatrix3x3(matrix);
    for (int i = 0; i < 9; ++i)
    {
      turn[i % 3][i / 3] = matrix[i / 3][i % 3];
    }
  }
  const glm::dvec3 scale = this->Scaling ? this->scaleOf(point) : glm::dvec3(1.0);
  place = glm::dmat4x3(turn[0] * scale.x, turn[1] * scale.y, turn[2] * scale.z,
    glm::make_vec3(this->Input->GetPoint(point)));
  double sum = 0.0;
  for (int i = 0; i < 12; ++i)
  {
    sum += std::abs(place[i / 3][i % 3]);
  }
  if (!std::isfinite(sum) || turn[0] == glm::dvec3(0.0))
  {
    return false; // a quaternion of zeros makes a matrix of zeros
  }
  // In the Frobenius norm; a turn has none.
  condition = std::max(condition, glm::length(scale) * glm::length(1.0 / scale));
  return true;
}
}
