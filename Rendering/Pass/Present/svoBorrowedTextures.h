// Textures that somebody else has made, by their names, for programs of VTK's.
#ifndef svoBorrowedTextures_h
#define svoBorrowedTextures_h

#include "svoShaderValues.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;

namespace svo
{
class BorrowedTextures
{
public:
  /// Those of the window's current context that are there until the next call or release().
  void update(vtkOpenGLRenderWindow* window, const std::vector<ShaderValues::Texture>& textures);
  void release();

  void activate();
  void deactivate();
  /// Activates them and says so to a program, which is in use.
  void send(vtkShaderProgram* program) const;

private:
  std::vector<const char*> Samplers;
  std::vector<vtkSmartPointer<vtkTextureObject>> Textures;
};
}

#endif
