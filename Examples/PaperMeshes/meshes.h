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

/// Reads A, decimated to `trianglesOfA` where it has more. Null, and one sentence in @a error, if
/// the file is unreadable.
vtkSmartPointer<vtkPolyData> readObjectA(const std::string& file, std::string& error);

/// Reads the first @a count poses of B, at most `posesOfB`, from key frames of a file, each
/// subdivided once. False, and one sentence in @a error, if the file is unreadable.
bool readObjectB(const std::string& file, unsigned int count,
  std::vector<vtkSmartPointer<vtkPolyData>>& poses, std::string& error);

/// Both, with all poses.
bool readMeshes(
  const std::string& fileOfA, const std::string& fileOfB, Meshes& meshes, std::string& error);

/// Generated objects of about the same sizes, for tests: a bumpy ball and a bending ellipsoid.
Meshes standInMeshes();
}

#endif
