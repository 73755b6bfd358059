#include "svoProgram.h"

#include "svoOpenGL.h"

namespace svo
{
unsigned int linkProgram(
  const std::vector<std::pair<unsigned int, std::string>>& shaders, std::string& words)
{
  const GLuint program = glCreateProgram();
  words.clear();
  char said[256] = "";
  for (const auto& [kind, text] : shaders)
  {
    const GLuint shader = glCreateShader(kind);
    const char* source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint done = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (!done && words.empty())
    {
      glGetShaderInfoLog(shader, sizeof(said), nullptr, said);
      words = said;
    }
    glAttachShader(program, shader);
    glDeleteShader(shader); // with the program
  }
  GLint linked = 0;
  glLinkProgram(program);
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked)
  {
    words.clear();
    return program;
  }
  if (words.empty())
  {
    glGetProgramInfoLog(program, sizeof(said), nullptr, said);
    words = said;
  }
  words = words.substr(0, words.find('\n'));
  glDeleteProgram(program);
  return 0;
}
}
