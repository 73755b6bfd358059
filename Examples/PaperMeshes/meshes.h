// The paper's two objects: A, a detailed rigid mesh, and B, a walking figure with one mesh per
// pose.
#ifndef PaperMeshes_meshes_h
#define PaperMeshes_meshes_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace paper
{
/// Triangles of object A as the paper prints them.
constexpr vtkIdType trianglesOfA = 16978;
/// Poses of object B.
constexpr unsigned int posesOfB = 50;

/**
 * Both objects stand on the plane z = 0 around the z axis, z up, with point normals. A is 1 high;
 * B's first pose is 1 high, and B looks along +x.
 */
struct Meshes
{
  vtkSmartPointer<vtkPolyData> a;
  std::vector<vtkSmartPointer<vtkPolyData>> b;
  std::string sourceOfA;
  std::string sourceOfB;
};

/**
 * Reads A from @a fileOfA, decimated to `trianglesOfA` where it has more, and B from 50 key frames
 * of
 * @a fileOfB, each subdivided once. False, and one sentence in @a error, if a file is unreadable.
 */
bool readMeshes(
  const std::string& fileOfA, const std::string& fileOfB, Meshes& meshes, std::string& error);

/// Generated objects of about the same sizes, for tests: a bumpy ball and a bending ellipsoid.
Meshes standInMeshes();
}

#endif
