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
inline constexpr char AllPixels[] = "#version 150\n"
                                    "void main()\n"
                                    "{\n"
                                    "  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0,\n"
                                    "    gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);\n"
                                    "}\n";
}

#endif
