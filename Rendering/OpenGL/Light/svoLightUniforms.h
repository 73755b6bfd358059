// The numbers of light code, sent to a program.
#ifndef svoLightUniforms_h
#define svoLightUniforms_h

#include "svoLightCode.h"
#include "vtkSVOOpenGLModule.h"

namespace svo
{
/// To OpenGL's program of that name, which is in use. What it has no uniform for is left out.
VTKSVOOPENGL_EXPORT void sendUniforms(unsigned int program, const LightCode& code);
}

#endif
