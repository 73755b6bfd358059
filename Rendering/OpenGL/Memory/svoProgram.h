// A program of the current context that is no VTK shader's.
#ifndef svoProgram_h
#define svoProgram_h

#include "vtkSVOOpenGLModule.h"

#include <string>
#include <utility>
#include <vector>

namespace svo
{
/// Of shaders by their kinds in OpenGL, whole texts; whoever asked deletes it. 0 if OpenGL refuses:
/// then `words`, a line, is why.
VTKSVOOPENGL_EXPORT unsigned int linkProgram(
  const std::vector<std::pair<unsigned int, std::string>>& shaders, std::string& words);

/// A vertex shader of GLSL 1.50 that covers all pixels with a triangle.
extern VTKSVOOPENGL_EXPORT const char* const AllPixels;
}

#endif
