// Meshes that the benchmarks run on: files, the demo's objects, and generated ones.
#ifndef svoBenchmarkMesh_h
#define svoBenchmarkMesh_h

#include "svoBuild.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace svobench
{
struct Mesh
{
  std::string name;
  std::vector<glm::dvec3> points;
  std::vector<glm::uvec3> triangles;

  svo::TriangleMesh view() const
  {
    return { points.data(), points.size(), triangles.data(), triangles.size() };
  }
};

/// Any format that Assimp knows. False, and one sentence in `error`, if it is unreadable.
bool readFile(const std::string& path, Mesh& mesh, std::string& error);

/**
 * Reads the mesh that argument `i` of the command line names: `--a FILE` for the paper's object A,
 * `--b FILE` for the first pose of B (Examples/PaperMeshes), `--ball N` for a bumpy sphere of about
 * N triangles, else the path of a file; `i` moves to its last word. False, and one sentence in
 * `error`, if it is unreadable.
 */
bool readArgument(int argc, char** argv, int& i, std::vector<Mesh>& meshes, std::string& error);

/// Radii 1 and 0.4; 2 rows columns triangles.
Mesh torus(unsigned rows, unsigned columns);
/// Radius about 1; 4 slices^2 triangles.
Mesh bumpySphere(unsigned slices);
/// Two triangles, a little tilted.
Mesh ground();
/// So many houses, 12 triangles each, on a ground of two; 1 along an edge.
Mesh city(unsigned houses);

vtkSmartPointer<vtkPolyData> polyData(const Mesh& mesh);

/// svo::detailLevel(), which is what the pass builds where leaves are exact.
int detailLevel(const Mesh& mesh);
}

#endif
