// Numbers, sent to a program.
#ifndef svoUniforms_h
#define svoUniforms_h

#include "svoShaderValues.h"
#include "vtkSVOOpenGLModule.h"

#include <glm/mat4x4.hpp>

namespace svo
{
/// To OpenGL's program of that name, which is in use. What it has no uniform for is left out.
VTKSVOOPENGL_EXPORT void sendUniforms(unsigned int program, const ShaderValues& code);

/// A uniform matrix of floats.
inline ShaderValues::Floats matrixOf(const char* name, const glm::dmat4& matrix)
{
  const glm::mat4 floats(matrix);
  return { name, 16, { &floats[0][0], &floats[0][0] + 16 } };
}
}

#endif
