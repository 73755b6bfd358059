// The meshes that accuracy is measured on.
#ifndef accuracyMesh_h
#define accuracyMesh_h

#include "svoBenchmarkMesh.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace accuracy
{
using svobench::Mesh;

/// Centres the mesh, makes its longest edge 1, turns it so that `up` (0 x, 1 y, 2 z) is z, puts it
/// on the plane z = 0, and rounds its points to floats, so that every program sees the same ones.
void normalise(Mesh& mesh, int up);

/// True if every edge has an even number of triangles, points of equal coordinates being one.
bool isClosed(const Mesh& mesh);

/// Closed body with hollows and ridges that shade each other: the stand-in of the short run.
Mesh knot();
/// Closed and convex: an ellipsoid of 2 rows columns triangles or fewer.
Mesh ellipsoid(unsigned rows, unsigned columns);
/// The corners of a box.
Mesh box(const glm::dvec3& low, const glm::dvec3& high);
/// A square of the plane z = 0.
Mesh ground(double half);

vtkSmartPointer<vtkPolyData> toPolyData(const Mesh& mesh);
/// Triangles as the engine cuts them; points in double.
Mesh fromPolyData(vtkPolyData* data, const std::string& name);
}

#endif
