// Draws the parts of pixels that svoSilhouettes.h finds, in a framebuffer with multisampling.
#ifndef svoPixelParts_h
#define svoPixelParts_h

#include "svoSilhouettes.h"

#include "vtkSmartPointer.h"

#include <vector>

#include <glm/vec2.hpp>

class vtkOpenGLBufferObject;
class vtkOpenGLRenderWindow;
class vtkOpenGLVertexArrayObject;

namespace svo
{
/// Where the samples of a pixel of the bound framebuffer lie, 0..1 from its lower left corner;
/// empty if it has one sample a pixel or multisampling is off.
std::vector<glm::vec2> samplePositions();

class PixelParts
{
public:
  void upload(const std::vector<PixelPart>& parts);
  /// Into the viewport that is set, which is as large as the frame. The depth test is the caller's.
  bool draw(vtkOpenGLRenderWindow* window, const float frameSize[2]);
  /// Drops all parts, and the buffers in OpenGL.
  void release();

private:
  struct Run
  {
    unsigned int samples;
    int first;
    int count;
  };
  std::vector<Run> Runs; // of parts that cover the same samples
  vtkSmartPointer<vtkOpenGLBufferObject> Buffer;
  vtkSmartPointer<vtkOpenGLVertexArrayObject> Array;
};
}

#endif
