// The stage that every image test plays on: a small window, a ground, a light and solids.
#ifndef svoTestStage_h
#define svoTestStage_h

#include "svoTestPicture.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSVORenderPass.h"
#include "vtkSmartPointer.h"

namespace svotest
{
/// A renderer with its pass, looking down at the origin from the side; z is up.
class Stage
{
public:
  /// In a window of its own.
  explicit Stage(int width = 300, int height = 300);
  /// In a part of another stage's window.
  Stage(Stage& neighbour, double xmin, double ymin, double xmax, double ymax);
  ~Stage();

  /// What a source makes, as an ordinary actor; not yet moved.
  vtkActor* add(vtkAlgorithm* source, double red, double green, double blue);
  /// A square of the given half size at z = 0.
  vtkActor* addGround(double halfSize = 3.0);
  /// A scene light that shines from x, y, z to the origin: a sun at any distance.
  vtkLight* addSun(double x, double y, double z);
  /// A scene light at x, y, z that shines everywhere.
  vtkLight* addBulb(double x, double y, double z);

  void usePass(bool on);
  /// The picture without shadows, with buffers, with rays.
  Picture unshadowed();
  Picture shadowed();
  Picture shadowedByRays();

  vtkRenderWindow* window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkSVORenderPass> pass;

private:
  vtkSmartPointer<vtkRenderWindow> owned;
};

vtkSmartPointer<vtkAlgorithm> ball(double radius, double x, double y, double z);
vtkSmartPointer<vtkAlgorithm> box(double edge, double x, double y, double z);
vtkSmartPointer<vtkAlgorithm> ring(double radius, double x, double y, double z);
vtkSmartPointer<vtkAlgorithm> spike(double height, double x, double y, double z);

/// Compares the window with the baseline that the command line names; both kept small.
bool matchesBaseline(vtkRenderWindow* window, int argc, char* argv[]);
}

#endif
