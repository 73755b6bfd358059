// What a program's uniforms are given. Plain data.
#ifndef svoShaderValues_h
#define svoShaderValues_h

#include <vector>

namespace svo
{
struct ShaderValues
{
  /// A texture of the current context.
  struct Texture
  {
    const char* sampler;
    unsigned int name;
    unsigned int target = 0x8c2a; // GL_TEXTURE_BUFFER
  };
  std::vector<Texture> textures;

  /// Numbers of an array, or one number.
  struct Integers
  {
    const char* name;
    std::vector<int> values;
  };
  struct Floats
  {
    const char* name;
    int components; // of each: 1, 3, 4, or 16 of a matrix, column by column
    std::vector<float> values;
  };
  std::vector<Integers> integers;
  std::vector<Floats> floats;
};
}

#endif
