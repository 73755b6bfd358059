#include "svoImpostors.h"

#include "vtkDataArray.h"
#include "vtkMath.h"
#include "vtkOpenGLSphereMapper.h"
#include "vtkOpenGLStickMapper.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkScalarsToColors.h"

// Only its header: the pass works where VTK is built without chemistry.
#if __has_include(<vtkMoleculeMapper.h>)
#include "vtkMoleculeMapper.h"
#define SVO_MOLECULES 1
#endif

#include <cmath>
#include <cstring>

namespace svo
{
namespace
{
// The mappers tell their subclasses only what they read.
struct AskingSpheres : public vtkOpenGLSphereMapper
{
  using vtkOpenGLSphereMapper::ScaleArray;
};
struct AskingSticks : public vtkOpenGLStickMapper
{
  using vtkOpenGLStickMapper::OrientationArray;
  using vtkOpenGLStickMapper::ScaleArray;
};

bool isOf(vtkMapper* mapper, const char* name)
{
  return std::strcmp(mapper->GetClassName(), name) == 0;
}

vtkDataArray* arrayOf(vtkPolyData* input, const char* name, int components)
{
  vtkDataArray* array = name ? input->GetPointData()->GetArray(name) : nullptr;
  const bool fits = array && array->GetNumberOfComponents() >= components &&
    array->GetNumberOfTuples() >= input->GetNumberOfPoints();
  return fits ? array : nullptr;
}

bool isFinite(const glm::dvec3& p)
{
  return std::isfinite(p.x + p.y + p.z);
}

/// Balls at the points, with radii by an array, or all with one.
void addBalls(vtkPolyData* input, vtkDataArray* radii, double radius, Impostors& result)
{
  const auto shapes = std::make_shared<RoundShapes>();
  shapes->width = RoundShapes::Width::World; // their shaders do not scale them
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 centre;
    input->GetPoint(i, &centre.x);
    const double own = std::abs(radii ? radii->GetComponent(i, 0) : radius);
    if (isFinite(centre) && std::isfinite(own) && own > 0.0)
    {
      shapes->ends.push_back(centre);
      shapes->radii.push_back(own);
    }
  }
  if (!shapes->ends.empty())
  {
    result.shapes.push_back(shapes);
  }
}

/// Rods around the points: `sizes` has lengths and radii, `ways` directions of length 1.
void addRods(vtkPolyData* input, vtkDataArray* sizes, vtkDataArray* ways, Impostors& result)
{
  const auto shapes = std::make_shared<RoundShapes>();
  shapes->shape = RoundShapes::Shape::Rod;
  shapes->width = RoundShapes::Width::World;
  for (vtkIdType i = 0; sizes && ways && i < input->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 centre, way;
    input->GetPoint(i, &centre.x);
    ways->GetTuple(i, &way.x);
    const glm::dvec3 half = 0.5 * sizes->GetComponent(i, 0) * way;
    const double radius = std::abs(sizes->GetComponent(i, 1));
    if (isFinite(centre + half) && std::isfinite(radius) && radius > 0.0 && half != glm::dvec3(0.0))
    {
      shapes->ends.push_back(centre - half);
      shapes->ends.push_back(centre + half);
      shapes->radii.push_back(radius);
    }
  }
  if (!shapes->ends.empty())
  {
    result.shapes.push_back(shapes);
  }
}

#ifdef SVO_MOLECULES
struct AskingMolecule : public vtkMoleculeMapper
{
  using vtkMoleculeMapper::AtomGlyphPolyData;
  using vtkMoleculeMapper::BondGlyphPolyData;
  using vtkMoleculeMapper::UpdateGlyphPolyData;
};

void addMolecule(vtkMoleculeMapper* mapper, Impostors& result)
{
  if (!mapper->GetInputDataObject(0, 0))
  {
    return;
  }
  (mapper->*(&AskingMolecule::UpdateGlyphPolyData))(); // as it does when it draws
  vtkPolyData* atoms = (mapper->*(&AskingMolecule::AtomGlyphPolyData)).Get();
  vtkPolyData* bonds = (mapper->*(&AskingMolecule::BondGlyphPolyData)).Get();
  if (vtkDataArray* radii = arrayOf(atoms, "Scale Factors", 1); radii && mapper->GetRenderAtoms())
  {
    addBalls(atoms, radii, 0.0, result);
  }
  if (mapper->GetRenderBonds())
  {
    addRods(
      bonds, arrayOf(bonds, "Scale Factors", 3), arrayOf(bonds, "Orientation Vectors", 3), result);
  }
}
#endif
}

bool isImpostorMapper(vtkMapper* mapper)
{
  return isOf(mapper, "vtkOpenGLSphereMapper") || isOf(mapper, "vtkOpenGLStickMapper")
#ifdef SVO_MOLECULES
    || isOf(mapper, "vtkOpenGLMoleculeMapper")
#endif
    ;
}

Impostors impostorsOf(vtkMapper* mapper)
{
  Impostors result;
#ifdef SVO_MOLECULES
  if (isOf(mapper, "vtkOpenGLMoleculeMapper"))
  {
    vtkScalarsToColors* colors = mapper->GetLookupTable();
    result.opaque = !colors || colors->IsOpaque();
    addMolecule(static_cast<vtkMoleculeMapper*>(mapper), result);
    return result;
  }
#endif
  auto* input = vtkPolyData::SafeDownCast(mapper->GetInputDataObject(0, 0));
  if (!input || !vtkMath::AreBoundsInitialized(mapper->GetBounds()))
  {
    return result; // points that no cell has have no bounds, and then VTK culls all of them
  }
  result.opaque = !mapper->HasTranslucentPolygonalGeometry();
  if (isOf(mapper, "vtkOpenGLSphereMapper"))
  {
    auto* spheres = static_cast<vtkOpenGLSphereMapper*>(mapper);
    addBalls(input, arrayOf(input, spheres->*(&AskingSpheres::ScaleArray), 1), spheres->GetRadius(),
      result);
  }
  else
  {
    auto* sticks = static_cast<vtkOpenGLStickMapper*>(mapper);
    addRods(input, arrayOf(input, sticks->*(&AskingSticks::ScaleArray), 3),
      arrayOf(input, sticks->*(&AskingSticks::OrientationArray), 3), result);
  }
  return result;
}
}
