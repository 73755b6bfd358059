#include "svoGlyphStage.h"

#include "vtkAppendPolyData.h"
#include "vtkBitArray.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkTriangleFilter.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>

namespace svotest
{
namespace
{
template <class Array>
vtkSmartPointer<Array> add(vtkPolyData* mesh, const char* name, int components)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(mesh->GetNumberOfPoints());
  mesh->GetPointData()->AddArray(array);
  return array;
}

/// Half of the points in a block, the others in a tree below.
vtkSmartPointer<vtkMultiBlockDataSet> pointTree(vtkPolyData* points)
{
  const auto part = [&](int first)
  {
    auto mesh = vtkSmartPointer<vtkPolyData>::New();
    vtkNew<vtkPoints> places;
    mesh->GetPointData()->CopyAllocate(points->GetPointData());
    for (vtkIdType i = first; i < points->GetNumberOfPoints(); i += 2)
    {
      mesh->GetPointData()->CopyData(
        points->GetPointData(), i, places->InsertNextPoint(points->GetPoint(i)));
    }
    mesh->SetPoints(places);
    return mesh;
  };
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(1, part(1));
  auto tree = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  tree->SetBlock(0, part(0));
  tree->SetBlock(3, inner);
  return tree;
}
}

vtkSmartPointer<vtkPolyData> glyphPoints()
{
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 20; ++i)
  {
    points->InsertNextPoint(-1.6 + 0.8 * (i % 5), -1.2 + 0.8 * (i / 5), 0.4 + 0.05 * i);
  }
  mesh->SetPoints(points);
  const auto size = add<vtkFloatArray>(mesh, "size", 1);
  const auto sizes = add<vtkDoubleArray>(mesh, "sizes", 3);
  const auto way = add<vtkFloatArray>(mesh, "way", 3);
  const auto angles = add<vtkDoubleArray>(mesh, "angles", 3);
  const auto turn = add<vtkDoubleArray>(mesh, "turn", 4);
  const auto shape = add<vtkIntArray>(mesh, "shape", 1);
  const auto shown = add<vtkBitArray>(mesh, "shown", 1);
  const auto value = add<vtkFloatArray>(mesh, "value", 1);
  const auto rgb = add<vtkUnsignedCharArray>(mesh, "rgb", 3);
  const auto rgba = add<vtkUnsignedCharArray>(mesh, "rgba", 4);
  for (int i = 0; i < 20; ++i)
  {
    size->SetValue(i, 0.5f + 0.05f * i);
    sizes->SetTuple3(i, 0.6 + 0.04 * i, i % 3 == 1 ? -0.8 : 1.1, 1.4 - 0.05 * i);
    // Among them the x axis, its opposite, and nothing at all.
    way->SetTuple3(i, i < 2 ? 1 - 2 * i : std::cos(0.9 * i), i < 3 ? 0 : std::sin(0.9 * i),
      i < 3 ? 0 : 0.5 * std::cos(0.4 * i));
    way->SetComponent(2, 0, 0.0f);
    angles->SetTuple3(i, 25.0 * i, -10.0 * i, 40.0 * i);
    turn->SetTuple4(i, std::cos(0.3 * i), 0.5 * std::sin(0.3 * i), 0.2 * i, 0.4);
    shape->SetValue(i, i % 5 - 1); // beyond a table of three; signs do not count
    shown->SetValue(i, i % 4 != 2);
    value->SetValue(i, static_cast<float>(i) / 19.0f);
    rgb->SetTuple3(i, 255 - 10 * i, 40 + 10 * i, 90 + (i % 3) * 60);
    rgba->SetTuple4(i, 40 + 10 * i, 255 - 10 * i, 80, i % 5 == 0 ? 120 : 255);
  }
  mesh->GetPointData()->SetActiveScalars("value");
  return mesh;
}

vtkSmartPointer<vtkPolyData> oddShape()
{
  vtkNew<vtkAppendPolyData> parts;
  parts->AddInputConnection(ball(0.14, 0.08, 0.0, 0.0)->GetOutputPort());
  parts->AddInputConnection(box(0.16, -0.1, 0.06, 0.0)->GetOutputPort());
  parts->AddInputConnection(spike(0.25, 0.0, -0.05, 0.15)->GetOutputPort());
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(parts->GetOutputPort());
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(triangles->GetOutputPort());
  normals->SetFeatureAngle(40.0);
  normals->Update();
  return normals->GetOutput();
}

GlyphStage::GlyphStage(int width, int height)
  : Stage(width, height)
{
  this->addSun(2.0, -1.5, 4.0);
  this->mapper->SetInputData(this->points);
  this->mapper->SetSourceData(oddShape());
  this->mapper->ScalarVisibilityOff();
  this->mapper->OrientOff();
  this->actor->SetMapper(this->mapper);
  this->actor->GetProperty()->SetColor(0.9, 0.7, 0.5);
  this->renderer->AddActor(this->actor);
}

void scaleBy(GlyphStage& stage, const char* array, bool components)
{
  stage.mapper->SetScaleArray(array);
  stage.mapper->SetScaleMode(
    components ? vtkGlyph3DMapper::SCALE_BY_COMPONENTS : vtkGlyph3DMapper::SCALE_BY_MAGNITUDE);
}

void orientBy(GlyphStage& stage, const char* array, int mode)
{
  stage.mapper->OrientOn();
  stage.mapper->SetOrientationArray(array);
  stage.mapper->SetOrientationMode(mode);
}

void colorBy(GlyphStage& stage, const char* array, int mode)
{
  stage.mapper->ScalarVisibilityOn();
  stage.mapper->SetScalarModeToUsePointFieldData();
  stage.mapper->SelectColorArray(array);
  stage.mapper->SetColorMode(mode);
}

vtkSmartPointer<vtkMultiBlockDataSet> useTree(GlyphStage& stage)
{
  const auto tree = pointTree(stage.points);
  stage.mapper->SetInputDataObject(tree);
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  stage.mapper->SetBlockAttributes(attributes);
  return tree;
}
}
