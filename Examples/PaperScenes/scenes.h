// An experiment as a VTK scene: a renderer with actors, one light and a clock.
#ifndef PaperScenes_scenes_h
#define PaperScenes_scenes_h

#include "experiments.h"
#include "objects.h"

#include <vtkActor.h>
#include <vtkLight.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <vector>

namespace paper
{
enum class LightKind
{
  Point, ///< shines in all directions, as the paper's
  Spot   ///< at the same place, its cone just around the objects: what vtkShadowMapPass can use
};

class Scene
{
public:
  Scene(const Experiment& experiment, const Objects& objects);

  /// Frames after which everything is where it was.
  static int period();
  /// Moves the spinning A and the walking B to frame @a frame of the animation, 25 a second.
  void setFrame(int frame);
  /// Turns object A number @a i by @a degrees from where it looks at frame 0.
  void turnA(std::size_t i, double degrees);
  /// Looks from a viewpoint, turned by @a orbit degrees around what it looks at.
  void setView(const Viewpoint& view, double orbit = 0);
  void setLight(LightKind kind);
  void setGroundVisible(bool visible);
  void setAVisible(bool visible);
  /// Shows B in one of its poses whatever the frame; nothing without a B.
  void setPose(std::size_t pose);
  /// A line at the lower left; empty for none. The renderer must be in a window.
  void setCaption(const std::string& text);

  const Experiment& experiment() const { return *this->Setup; }
  vtkRenderer* renderer() const { return this->Renderer; }
  vtkIdType trianglesShown() const;
  vtkIdType trianglesInMemory() const;
  double buildSeconds() const;
  double octreeMebibytes() const;
  vtkIdType voxels() const;

private:
  /// Sums a figure over the kinds of object that the scene has: A once, as all share one octree.
  template <class Figure>
  Figure total(Figure Object::*figure) const;

  const Experiment* Setup;
  const Objects* Shapes;
  vtkSmartPointer<vtkRenderer> Renderer = vtkSmartPointer<vtkRenderer>::New();
  vtkSmartPointer<vtkLight> Light = vtkSmartPointer<vtkLight>::New();
  vtkSmartPointer<vtkTextActor> Caption = vtkSmartPointer<vtkTextActor>::New();
  vtkSmartPointer<vtkActor> Ground;
  std::vector<vtkSmartPointer<vtkActor>> A;
  vtkSmartPointer<vtkActor> B;
};
}

#endif
