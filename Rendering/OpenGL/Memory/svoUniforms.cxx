#include "svoUniforms.h"

#include "svoOpenGL.h"

namespace svo
{
void sendUniforms(unsigned int program, const ShaderValues& code)
{
  for (const ShaderValues::Integers& entry : code.integers)
  {
    glUniform1iv(glGetUniformLocation(program, entry.name),
      static_cast<GLsizei>(entry.values.size()), entry.values.data());
  }
  for (const ShaderValues::Floats& entry : code.floats)
  {
    const GLint at = glGetUniformLocation(program, entry.name);
    const auto count = static_cast<GLsizei>(entry.values.size()) / entry.components;
    if (entry.components == 16)
    {
      glUniformMatrix4fv(at, count, GL_FALSE, entry.values.data());
    }
    else if (entry.components == 4)
    {
      glUniform4fv(at, count, entry.values.data());
    }
    else if (entry.components == 3)
    {
      glUniform3fv(at, count, entry.values.data());
    }
    else
    {
      glUniform1fv(at, count, entry.values.data());
    }
  }
}
}
