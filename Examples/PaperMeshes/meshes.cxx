// The paper's two objects, read from files or generated.
#include "meshes.h"

#include "loaders.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataNormals.h>
#include <vtkQuadricDecimation.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>
#include <vtkTransformFilter.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace paper
{
namespace
{
using Mesh = vtkSmartPointer<vtkPolyData>;

struct KeyFrames
{
  unsigned int first;
  unsigned int count;
};
// A Quake II player model: run, crouched walk, jump, salute, wave, stand.
constexpr KeyFrames keyFramesOfB[] = { { 40, 6 }, { 154, 6 }, { 66, 6 }, { 84, 11 }, { 112, 11 },
  { 0, 10 } };
constexpr unsigned int standingKeyFrame = 0;

/// Collapsing an edge removes one or two triangles, so the count is met exactly or missed by one.
Mesh decimated(vtkPolyData* mesh, vtkIdType triangles)
{
  if (mesh->GetNumberOfPolys() <= triangles)
  {
    return mesh;
  }
  vtkNew<vtkQuadricDecimation> decimate;
  decimate->SetInputData(mesh);
  decimate->SetTargetReduction(1.0 - static_cast<double>(triangles) / mesh->GetNumberOfPolys());
  decimate->Update();
  return decimate->GetOutput();
}

Mesh withNormals(vtkPolyData* mesh)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(mesh);
  normals->SplittingOff();
  normals->ConsistencyOff();
  normals->Update();
  return normals->GetOutput();
}

/**
 * Splits every triangle in four at the middles of its edges; the shape stays what it is, and the
 * normals are interpolated. (VTK's subdivision filters refuse a mesh that is not a manifold.)
 */
Mesh subdivided(vtkPolyData* mesh)
{
  vtkNew<vtkPoints> points;
  points->DeepCopy(mesh->GetPoints());
  vtkNew<vtkFloatArray> normals;
  normals->DeepCopy(mesh->GetPointData()->GetNormals());
  std::map<std::pair<vtkIdType, vtkIdType>, vtkIdType> middles;
  const auto middle = [&](vtkIdType i, vtkIdType j)
  {
    const auto [entry, isNew] =
      middles.insert({ { std::min(i, j), std::max(i, j) }, points->GetNumberOfPoints() });
    if (isNew)
    {
      double p[3], q[3], m[3], n[3];
      points->GetPoint(i, p);
      points->GetPoint(j, q);
      normals->GetTuple(i, m);
      normals->GetTuple(j, n);
      vtkMath::Add(m, n, n);
      vtkMath::Normalize(n);
      points->InsertNextPoint(0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.5 * (p[2] + q[2]));
      normals->InsertNextTuple(n);
    }
    return entry->second;
  };

  vtkNew<vtkCellArray> triangles;
  const auto add = [&](vtkIdType i, vtkIdType j, vtkIdType k)
  {
    const vtkIdType ids[3] = { i, j, k };
    triangles->InsertNextCell(3, ids);
  };
  vtkIdType count = 0;
  const vtkIdType* t = nullptr;
  vtkCellArray* coarse = mesh->GetPolys();
  for (coarse->InitTraversal(); coarse->GetNextCell(count, t);)
  {
    const vtkIdType m[3] = { middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0]) };
    add(t[0], m[0], m[2]);
    add(m[0], t[1], m[1]);
    add(m[2], m[1], t[2]);
    add(m[0], m[1], m[2]);
  }
  auto result = Mesh::New();
  result->SetPoints(points);
  result->SetPolys(triangles);
  result->GetPointData()->SetNormals(normals);
  return result;
}

/// From a file's y-up frame to z-up, turned by @a heading degrees, standing on z = 0 and 1 high.
vtkSmartPointer<vtkTransform> standUpright(vtkPolyData* mesh, double heading)
{
  vtkNew<vtkTransform> turn;
  turn->RotateZ(heading);
  turn->RotateX(90);
  vtkNew<vtkTransformFilter> turned;
  turned->SetInputData(mesh);
  turned->SetTransform(turn);
  turned->Update();
  double bounds[6];
  turned->GetOutput()->GetBounds(bounds);

  auto upright = vtkSmartPointer<vtkTransform>::New();
  const double scale = 1.0 / (bounds[5] - bounds[4]);
  upright->Scale(scale, scale, scale);
  upright->Translate(-0.5 * (bounds[0] + bounds[1]), -0.5 * (bounds[2] + bounds[3]), -bounds[4]);
  upright->Concatenate(turn);
  return upright;
}

Mesh transformed(vtkPolyData* mesh, vtkTransform* transform)
{
  vtkNew<vtkTransformFilter> filter;
  filter->SetInputData(mesh);
  filter->SetTransform(transform);
  filter->Update();
  return filter->GetPolyDataOutput();
}

Mesh sphere(int thetaResolution, int phiResolution)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(thetaResolution);
  source->SetPhiResolution(phiResolution);
  source->SetRadius(0.5);
  source->SetCenter(0, 0, 0.5);
  source->Update();
  return source->GetOutput();
}

template <class Move>
Mesh moved(vtkPolyData* mesh, Move&& move)
{
  auto result = Mesh::New();
  result->CopyStructure(mesh);
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(mesh->GetNumberOfPoints());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double p[3];
    mesh->GetPoint(i, p);
    move(p);
    points->SetPoint(i, p);
  }
  result->SetPoints(points);
  return withNormals(result);
}
}

Mesh readObjectA(const std::string& file, std::string& error)
{
  Mesh a = readTriangles(file, 0, error);
  if (!a)
  {
    return nullptr;
  }
  a = decimated(a, trianglesOfA);
  return withNormals(transformed(a, standUpright(a, 0)));
}

bool readObjectB(
  const std::string& file, unsigned int count, std::vector<Mesh>& poses, std::string& error)
{
  poses.clear();
  // The standing pose says where the ground is: a running figure leaves it.
  const Mesh standing = readTriangles(file, standingKeyFrame, error);
  if (!standing)
  {
    return false;
  }
  const auto upright = standUpright(standing, 0);
  for (const KeyFrames& range : keyFramesOfB)
  {
    for (unsigned int i = 0; i < range.count && poses.size() < count; ++i)
    {
      const Mesh pose = readTriangles(file, range.first + i, error);
      if (!pose)
      {
        return false;
      }
      poses.push_back(subdivided(withNormals(transformed(pose, upright))));
    }
  }
  return true;
}

bool readMeshes(
  const std::string& fileOfA, const std::string& fileOfB, Meshes& meshes, std::string& error)
{
  meshes.a = readObjectA(fileOfA, error);
  meshes.sourceOfA = fileOfA;
  meshes.sourceOfB = fileOfB;
  return meshes.a && readObjectB(fileOfB, posesOfB, meshes.b, error);
}

Meshes standInMeshes()
{
  Meshes meshes;
  const Mesh ball = decimated(sphere(100, 102), trianglesOfA);
  meshes.a = moved(ball,
    [](double p[3])
    {
      const double direction[3] = { p[0], p[1], p[2] - 0.5 };
      const double bump = 1.0 +
        0.13 * std::sin(16 * direction[0]) * std::sin(16 * direction[1] + 1) *
          std::sin(16 * direction[2] + 2);
      p[0] *= bump;
      p[1] *= bump;
      p[2] = 0.5 + direction[2] * bump;
    });
  meshes.sourceOfA = "generated";

  // 34 x 30 quads' worth of triangles, 2040: the paper's object B.
  const Mesh body = sphere(34, 32);
  for (unsigned int pose = 0; pose < posesOfB; ++pose)
  {
    const double phase = 2 * vtkMath::Pi() * pose / posesOfB;
    meshes.b.push_back(moved(body,
      [phase](double p[3])
      {
        const double width = 0.5 + 0.06 * std::sin(2 * phase);
        p[0] = width * p[0] + 0.2 * p[2] * p[2] * std::sin(phase);
        p[1] = width * p[1] + 0.08 * std::sin(6 * p[2] + phase);
      }));
  }
  meshes.sourceOfB = "generated";
  return meshes;
}
}
