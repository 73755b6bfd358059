// Reads triangle meshes by way of Assimp.
#include "loaders.h"

#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#ifdef PAPERMESHES_WITH_ASSIMP
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#endif

namespace paper
{
#ifdef PAPERMESHES_WITH_ASSIMP
namespace
{
void append(const aiMesh& mesh, vtkPoints* points, vtkCellArray* triangles)
{
  const vtkIdType first = points->GetNumberOfPoints();
  for (unsigned int i = 0; i < mesh.mNumVertices; ++i)
  {
    points->InsertNextPoint(mesh.mVertices[i].x, mesh.mVertices[i].y, mesh.mVertices[i].z);
  }
  for (unsigned int i = 0; i < mesh.mNumFaces; ++i)
  {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices == 3)
    {
      const vtkIdType ids[3] = { first + face.mIndices[0], first + face.mIndices[1],
        first + face.mIndices[2] };
      triangles->InsertNextCell(3, ids);
    }
  }
}
}

namespace
{
/// An OFF file without what Assimp stumbles over: comments anywhere, and colours of three numbers
/// behind the vertices.
std::string plainOFF(const std::string& path)
{
  std::ifstream file(path);
  std::string text = "OFF\n", line;
  std::size_t vertices = 0;
  for (std::size_t row = 0; std::getline(file, line);)
  {
    line.erase(std::min(line.find('#'), line.size()));
    std::istringstream words(line);
    std::string word[3];
    if (!(words >> word[0]) || row++ == 0) // nothing, or the first line's OFF
    {
      continue;
    }
    words >> word[1] >> word[2];
    const bool vertex = row > 2 && row <= 2 + vertices;
    text += (vertex ? word[0] + ' ' + word[1] + ' ' + word[2] : line) + '\n';
    if (row == 2)
    {
      vertices = std::strtoul(word[0].c_str(), nullptr, 10);
    }
  }
  return text;
}
}

vtkSmartPointer<vtkPolyData> readTriangles(
  const std::string& path, unsigned int keyFrame, std::string& error)
{
  if (!vtksys::SystemTools::TestFileAccess(path, vtksys::TEST_FILE_READ) ||
    vtksys::SystemTools::FileIsDirectory(path))
  {
    error = "cannot open \"" + path + "\" for reading.";
    return nullptr;
  }
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_IMPORT_GLOBAL_KEYFRAME, static_cast<int>(keyFrame));
  constexpr unsigned int steps = aiProcess_Triangulate | aiProcess_PreTransformVertices;
  const aiScene* scene = importer.ReadFile(path, steps);
  if (!scene && vtksys::SystemTools::GetFilenameLastExtension(path) == ".off")
  {
    const std::string text = plainOFF(path);
    scene = importer.ReadFileFromMemory(text.data(), text.size(), steps, "off");
  }
  if (!scene)
  {
    error = "cannot read \"" + path + "\" as a mesh: " + importer.GetErrorString();
    return nullptr;
  }
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> triangles;
  for (unsigned int i = 0; i < scene->mNumMeshes; ++i)
  {
    append(*scene->mMeshes[i], points, triangles);
  }
  if (triangles->GetNumberOfCells() == 0)
  {
    error = "\"" + path + "\" holds no triangles.";
    return nullptr;
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);

  // Assimp hands MD2's triangles out with three vertices each; smooth normals need shared ones.
  vtkNew<vtkCleanPolyData> weld;
  weld->SetInputData(mesh);
  weld->ToleranceIsAbsoluteOn();
  weld->SetAbsoluteTolerance(0);
  weld->ConvertPolysToLinesOff();
  weld->ConvertLinesToPointsOff();
  weld->Update();
  return weld->GetOutput();
}

#else

vtkSmartPointer<vtkPolyData> readTriangles(
  const std::string& path, unsigned int, std::string& error)
{
  error = "cannot read \"" + path + "\": this program was built without Assimp (libassimp-dev).";
  return nullptr;
}
#endif
}
