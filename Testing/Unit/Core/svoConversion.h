// A mesh and what the conversion filter makes of it.
#ifndef svoConversion_h
#define svoConversion_h

#include "svoMeshOctree.h"
#include "svoTestMessages.h"
#include "vtkPolyDataToSVO.h"

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"

#include <string>

#include <gtest/gtest.h>

inline vtkSmartPointer<vtkPolyData> sphere(double radius = 0.5)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(16);
  source->SetPhiResolution(12);
  source->SetRadius(radius);
  source->Update();
  return source->GetOutput();
}

inline svo::Octree octreeOf(vtkPolyData* mesh)
{
  svo::Octree octree;
  std::string message;
  svo::openAttachedOctree(mesh, octree, message);
  return octree;
}

/// Converts a mesh, which passes through.
struct Conversion
{
  vtkNew<vtkPolyDataToSVO> filter;
  svo::TestMessages messages{ filter };

  explicit Conversion(vtkPolyData* mesh, int level = 4)
  {
    this->filter->SetInputData(mesh);
    this->filter->SetMaximumLevel(level);
    this->filter->Update();
    EXPECT_EQ(this->filter->GetOutput()->GetNumberOfPoints(), mesh->GetNumberOfPoints());
    EXPECT_EQ(this->filter->GetOutput()->GetNumberOfCells(), mesh->GetNumberOfCells());
  }
  svo::Octree octree() const { return octreeOf(this->filter->GetOutput()); }
};

#endif
