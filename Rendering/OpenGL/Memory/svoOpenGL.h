// OpenGL's functions as VTK loads them: through GLEW, from VTK 9.4 on through glad.
#ifndef svoOpenGL_h
#define svoOpenGL_h

#if __has_include(<vtk_glad.h>)
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

#endif
