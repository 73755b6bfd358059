// Surfaces that VTK's shaders trace (svoEyeCode.h), as actors that draw their boxes.
#ifndef svoTracedBoxes_h
#define svoTracedBoxes_h

#include "svoBorrowedTextures.h"
#include "svoEyeCode.h"
#include "svoScene.h"

#include "vtkSmartPointer.h"

#include <set>
#include <string>
#include <vector>

class vtkActor;
class vtkOpenGLRenderWindow;
class vtkProp;
class vtkViewport;
class vtkWindow;

namespace svo
{
class TracedBoxes
{
public:
  /// True if OpenGL compiles the code, or there is nothing to draw. Else why not stands in
  /// refusal(), a sentence, until release(): VTK's shaders with it would fail.
  bool accepts(const EyeCode& code);
  const std::string& refusal() const { return this->Refusal; }

  /// For a frame: code that lives until the next call or release(), its scene, and the prop of each
  /// instance, with whose keys its box is drawn, at once with those after it of the same prop and
  /// look.
  void update(vtkOpenGLRenderWindow* window, const EyeCode& code, const Scene& scene,
    const std::vector<vtkProp*>& props);
  /// Has nothing to draw.
  void clear();
  void release();
  void releaseGraphicsResources(vtkWindow* window);

  bool empty() const { return this->Props.empty(); }
  /// With `only`, those of these props. `presenter`: that in a frame has the passes that their
  /// props, which are not in it, would have.
  void draw(vtkViewport* viewport, const std::set<vtkProp*>* only, vtkProp* presenter = nullptr);

private:
  class ForwardingPass;
  void takeKeys(vtkActor* actor, vtkProp* prop, vtkProp* presenter);

  std::vector<vtkProp*> Props; // of boxes that are drawn at once
  std::vector<vtkSmartPointer<vtkActor>> Actors;
  std::vector<vtkSmartPointer<ForwardingPass>> Passes; // that boxes were drawn with
  BorrowedTextures Textures;
  std::string Constants, Refusal; // of the code that was tried last, and of it
};
}

#endif
