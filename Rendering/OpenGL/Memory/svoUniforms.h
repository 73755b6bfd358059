// Numbers, sent to a program.
#ifndef svoUniforms_h
#define svoUniforms_h

#include "svoShaderValues.h"
#include "vtkSVOOpenGLModule.h"

namespace svo
{
/// To OpenGL's program of that name, which is in use. What it has no uniform for is left out.
VTKSVOOPENGL_EXPORT void sendUniforms(unsigned int program, const ShaderValues& code);
}

#endif
