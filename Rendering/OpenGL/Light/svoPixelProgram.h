// A program that is asked for all pixels of a picture: by compute shaders, or by fragments of a
// triangle over all of them.
#ifndef svoPixelProgram_h
#define svoPixelProgram_h

#include "svoShaderValues.h"
#include "vtkSVOOpenGLModule.h"

#include <string>
#include <utility>
#include <vector>

class vtkOpenGLState;

namespace svo
{
/// Of one renderer. All calls are made in its context; whoever owns one is told before it goes.
class PixelProgram
{
public:
  /// True if the context has compute shaders (OpenGL 4.3).
  static VTKSVOOPENGL_EXPORT bool hasCompute();

  /// Makes it of a text with what svoPixelMain.glsl asks. False, and `words` has OpenGL's, if it
  /// refuses.
  bool link(const std::string& text, bool computes, std::string& words);
  bool linked() const { return this->Program != 0; }
  bool computes() const { return this->Computes; }
  void release();

  /// A layer of a texture that is filled, or added to: in a framebuffer, or as the image that is
  /// bound to unit 0.
  struct Layer
  {
    unsigned int framebuffer, texture, format;
    int layer, width, height;
    bool adds = false;
  };

  /// The program in use, with what it reads.
  class Use
  {
  public:
    Use(vtkOpenGLState* state, const PixelProgram& program, const ShaderValues& values,
      const std::vector<ShaderValues::Texture>& textures);
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
    ~Use();

    void set(const char* uniform, int value);
    void set(const char* uniform, float value);
    /// Asks for all of its pixels. In the framebuffer, blending is the caller's.
    void fill(const Layer& layer);

  private:
    vtkOpenGLState* State;
    const PixelProgram& Of;
    int ProgramBefore = 0, VerticesBefore = 0;       // VTK knows what it has bound
    std::vector<std::pair<int, unsigned int>> Units; // with their targets
  };

private:
  unsigned int Program = 0, Vertices = 0;
  bool Computes = false;
};
}

#endif
