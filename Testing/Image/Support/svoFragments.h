// One fragment of a shader for each of many cases: numbers go in, numbers come out.
#ifndef svoFragments_h
#define svoFragments_h

#include <array>
#include <functional>
#include <string>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;

namespace svotest
{
using FourFloats = std::array<float, 4>;

/// Runs a fragment shader for size * size cases, into whatever is bound. `inputs`: textures that
/// the shader finds as `uniform sampler2D input0`, `input1` and so on, a texel a case, at
/// ivec2(gl_FragCoord). `declarations` stand before main(), whose body is `main`. `prepare` sets
/// further uniforms. False if the shader could not be made.
bool drawFragments(vtkOpenGLRenderWindow* window, int size,
  const std::vector<std::vector<FourFloats>>& inputs, const std::string& declarations,
  const std::string& main, const std::function<void(vtkShaderProgram*)>& prepare);

/// What a shader writes to gl_FragData[0]; the rest as above. Empty if it could not be made.
std::vector<FourFloats> runFragments(vtkOpenGLRenderWindow* window, int size,
  const std::vector<std::vector<FourFloats>>& inputs, const std::string& declarations,
  const std::string& main, const std::function<void(vtkShaderProgram*)>& prepare);
}

#endif
