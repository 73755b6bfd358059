#include "svoBackgroundBuild.h"

#include "vtkCellArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <new>
#include <system_error>
#include <utility>

namespace svo
{
vtkSmartPointer<vtkPolyData> privateCopy(vtkPolyData* mesh)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  auto points = vtkSmartPointer<vtkPoints>::New();
  if (mesh->GetPoints())
  {
    points->DeepCopy(mesh->GetPoints());
  }
  copy->SetPoints(points);
  const auto cells = [](vtkCellArray* source)
  {
    auto result = vtkSmartPointer<vtkCellArray>::New();
    result->DeepCopy(source);
    return result;
  };
  copy->SetVerts(cells(mesh->GetVerts()));
  copy->SetLines(cells(mesh->GetLines()));
  copy->SetPolys(cells(mesh->GetPolys()));
  copy->SetStrips(cells(mesh->GetStrips()));
  return copy;
}

std::unique_ptr<BackgroundBuild> BackgroundBuild::start(
  vtkPolyData* mesh, const MeshOctreeOptions& options, const Launcher& launch)
{
  try
  {
    std::unique_ptr<BackgroundBuild> build(new BackgroundBuild);
    std::function<void()> body = [self = build.get(), copy = privateCopy(mesh), options]
    { self->run(copy, options); };
    build->Thread = launch ? launch(std::move(body)) : std::thread(std::move(body));
    return build;
  }
  catch (const std::bad_alloc&)
  {
  }
  catch (const std::system_error&)
  {
  }
  return nullptr;
}

BackgroundBuild::~BackgroundBuild()
{
  this->abandon();
  if (this->Thread.joinable())
  {
    this->Thread.join();
  }
}

void BackgroundBuild::run(vtkPolyData* mesh, MeshOctreeOptions options)
{
  options.parallelFor = backgroundParallelFor();
  if (options.memoryLimit == 0)
  {
    options.memoryLimit = availableMemory() / MostAtATime;
  }
  options.progress = [this](double amount)
  {
    this->Progress = amount;
    return !this->abandoned();
  };
  this->Made.status = buildMeshOctree(mesh, options, this->Made.octree, this->Made.message);
  this->Done = true;
}

const BackgroundBuild::Result& BackgroundBuild::result()
{
  if (this->Thread.joinable())
  {
    this->Thread.join();
  }
  return this->Made;
}
}
