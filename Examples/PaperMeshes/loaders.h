// Reads triangle meshes from formats VTK 9.1 has no reader for (OFF, MD2), by way of Assimp.
#ifndef PaperMeshes_loaders_h
#define PaperMeshes_loaders_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

namespace paper
{
/**
 * Reads one key frame (0 for a file without animation) of any file that Assimp knows. The result
 * has welded vertices, triangles only, and no normals or texture coordinates. On failure the result
 * is null and @a error says in one sentence what is wrong with which file.
 */
vtkSmartPointer<vtkPolyData> readTriangles(
  const std::string& path, unsigned int keyFrame, std::string& error);
}

#endif
