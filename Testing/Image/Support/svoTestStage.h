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
/// Whether tests are to be drawn by OpenGL, VTKSVO_TEST_BACKEND=OpenGL in the environment: VTK
/// draws all, nothing is traced for the eye, and octrees answer for the light, by rays in its
/// shaders; or with VTKSVO_TEST_BACKEND=Volumes shadow volumes do.
bool drawnByOpenGL();
/// Has a pass draw so, if that is so. Those of stages do.
void chooseBackend(vtkSVORenderPass* pass);

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
  /// That so many actors were traced for the eye, or left to the rasteriser, in the last frame.
  /// With OpenGL none are traced, and at least so many rasterised.
  void expectTraced(
    Checks& checks, int actors, const std::string& sentence, int withOpenGL = 0) const;
  void expectRasterized(Checks& checks, int actors, const std::string& sentence) const;
  /// That so many instances have an octree in the frame. OpenGL needs none without shadows: another
  /// frame is drawn, which has them.
  void expectInstances(Checks& checks, int instances, const std::string& sentence);
  /// The picture without shadows; with those that the backend makes by itself, buffers of the CPU
  /// or OpenGL's rays; with either.
  Picture unshadowed();
  Picture shadowed();
  Picture shadowedByBuffers();
  Picture shadowedByRays();

  vtkRenderWindow* window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkSVORenderPass> pass;

private:
  vtkSmartPointer<vtkRenderWindow> owned;
};

/// A ground, a box, a ball, and a ring, which is returned.
vtkActor* addThings(Stage& stage);

/// Solids on a ground, moved and stretched; returns a box.
vtkActor* addShapes(Stage& stage);

/// Leaves all actors of a stage to the rasteriser.
void rasterizeAll(const Stage& stage);

vtkSmartPointer<vtkAlgorithm> ball(double radius, double x, double y, double z);
vtkSmartPointer<vtkAlgorithm> box(double edge, double x, double y, double z);
vtkSmartPointer<vtkAlgorithm> ring(double radius, double x, double y, double z);
vtkSmartPointer<vtkAlgorithm> spike(double height, double x, double y, double z);

/// Compares the window with the baseline that the command line names; both kept small.
bool matchesBaseline(vtkRenderWindow* window, int argc, char* argv[]);
}

#endif
