// A sphere is converted, asked for a hit, and rendered with its shadow on the ground; the exit code
// says whether all three worked.
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataToSVO.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSVORenderPass.h>
#include <vtkSparseVoxelOctree.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <iostream>

int main()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(0, 0, 1);
  vtkNew<vtkPolyDataToSVO> toOctree;
  toOctree->SetInputConnection(sphere->GetOutputPort());
  toOctree->SetMaximumLevel(7);
  toOctree->Update();

  vtkNew<vtkSparseVoxelOctree> octree;
  if (!octree->Initialize(toOctree->GetOutput()))
  {
    std::cerr << "no octree on the output\n";
    return 1;
  }
  const double above[3] = { 0.01, 0.02, 3.0 };
  const double below[3] = { 0.01, 0.02, 1.0 };
  double t = -1.0;
  double x[3] = { 0.0, 0.0, 0.0 };
  vtkIdType cell = -1;
  if (octree->IntersectWithLine(above, below, t, x, cell) != 1 || std::abs(x[2] - 1.5) > 0.05)
  {
    std::cerr << "the line from above should meet the sphere's top, not z = " << x[2] << "\n";
    return 1;
  }

  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-2, -2, 0);
  plane->SetPoint1(2, -2, 0);
  plane->SetPoint2(-2, 2, 0);
  vtkNew<vtkPolyDataMapper> sphereMapper;
  sphereMapper->SetInputConnection(toOctree->GetOutputPort());
  vtkNew<vtkPolyDataMapper> planeMapper;
  planeMapper->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor> sphereActor;
  sphereActor->SetMapper(sphereMapper);
  vtkNew<vtkActor> planeActor;
  planeActor->SetMapper(planeMapper);

  // From the side of the camera, so that the shadow falls where it is seen.
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(3, 0, 4);
  light->SetFocalPoint(0, 0, 1);
  vtkNew<vtkSVORenderPass> pass;
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(sphereActor);
  renderer->AddActor(planeActor);
  renderer->AddLight(light);
  renderer->SetPass(pass);
  renderer->GetActiveCamera()->SetPosition(0, 0, 8);
  renderer->GetActiveCamera()->SetFocalPoint(0, 0, 0);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(true);
  window->SetMultiSamples(0);
  window->SetSize(200, 200);
  window->AddRenderer(renderer);
  window->Render();

  // The light passes the sphere's centre and meets the ground at x = -1.
  auto brightness = [&](double wx, double wy)
  {
    renderer->SetWorldPoint(wx, wy, 0.0, 1.0);
    renderer->WorldToDisplay();
    const double* display = renderer->GetDisplayPoint();
    vtkNew<vtkUnsignedCharArray> pixel;
    const int px = static_cast<int>(display[0]);
    const int py = static_cast<int>(display[1]);
    window->GetPixelData(px, py, px, py, 1, pixel);
    return static_cast<int>(pixel->GetValue(0));
  };
  const int shadowed = brightness(-1.0, 0.0);
  const int lit = brightness(-1.0, 1.5);
  std::cout << "ground in the shadow " << shadowed << ", in the light " << lit << "\n";
  window->Finalize();
  return shadowed < lit / 2 ? 0 : 1;
}
