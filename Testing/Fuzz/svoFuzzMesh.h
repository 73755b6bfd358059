// The mesh whose octree is damaged: an octahedron and a needle, nine triangles.
#ifndef svoFuzzMesh_h
#define svoFuzzMesh_h

#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cstddef>

namespace svofuzz
{
/// Inputs that were opened and traced, not refused.
inline std::size_t traced = 0;

inline vtkPolyData* mesh()
{
  static vtkPolyData* const instance = []
  {
    constexpr double Points[][3] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 },
      { 0, 0, 1 }, { 0, 0, -1 }, { -0.9, -0.9, -0.9 }, { 0.9, 0.8, 0.7 }, { 0.9, 0.8, 0.71 } };
    constexpr vtkIdType Triangles[][3] = { { 0, 2, 4 }, { 2, 1, 4 }, { 1, 3, 4 }, { 3, 0, 4 },
      { 2, 0, 5 }, { 1, 2, 5 }, { 3, 1, 5 }, { 0, 3, 5 }, { 6, 7, 8 } };
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const auto& p : Points)
    {
      points->InsertNextPoint(p);
    }
    vtkNew<vtkCellArray> triangles;
    for (const auto& t : Triangles)
    {
      triangles->InsertNextCell(3, t);
    }
    vtkPolyData* made = vtkPolyData::New(); // never destroyed: inputs may come to the very end
    made->SetPoints(points);
    made->SetPolys(triangles);
    return made;
  }();
  return instance;
}
}

#endif
