// Shadows on surfaces that the rasteriser draws, through VTK's hook into its mappers' shaders.
#ifndef svoShadowReceivers_h
#define svoShadowReceivers_h

#include "svoBorrowedTextures.h"
#include "svoLightCode.h"

#include <string>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;

namespace svo
{
/// Puts one renderer's light code into VTK's shaders.
class ShadowReceivers
{
public:
  /// For a frame: the code, which must live until the next call or release(), in a window's current
  /// context; the share of a light that shadows take; whether there are shadow catchers, surfaces
  /// of which the shadows alone are seen.
  void update(
    vtkOpenGLRenderWindow* window, const LightCode& code, double intensity, bool catchers);
  void release();
  /// Whether the window shows facets mirrored (View::mirrored).
  void setMirrored(bool on) { this->Mirrored = on; }

  /// True if shaders need nothing of this.
  bool idle() const { return this->empty() && !this->Catchers; }

  /// True if the code wants to know where surfaces lie, before they are drawn.
  bool gathers() const { return !this->empty() && this->Code->fromPlaces; }
  /// True if it lights what is under no light at all: VTK's shaders need one for that, a black one.
  bool unlit() const { return !this->empty() && this->Code->unlit && this->Code->hasAround(); }
  /// While it is on, surfaces do not show light: they write where they lie (LightCode::fromPlaces).
  /// `behind`: PlaceBuffer::Draw.
  void setGathers(bool on, int behind = 0)
  {
    this->Gathers = on;
    this->Behind = behind;
  }

  void activate() { this->Textures.activate(); }
  void deactivate() { this->Textures.deactivate(); }

  /// Equal strings mean equal shaders.
  std::string signature() const;

  /// Two steps around VTK's own replacements: marks first, then code.
  static void markShader(std::string& fragmentShader);
  void completeShader(
    std::string& vertexShader, std::string& geometryShader, std::string& fragmentShader) const;
  /// Of a surface: whether shadows fall on it, whether these alone are seen of it, and whether
  /// nothing is seen through it.
  void setUniforms(
    vtkShaderProgram* program, bool receives, bool catches, bool opaque = true) const;

  /// What completeShader() puts before a fragment shader's main().
  std::string declarations() const;

private:
  bool empty() const { return !this->Code || this->Code->empty(); }

  const LightCode* Code = nullptr;
  BorrowedTextures Textures; // the code's
  float Intensity = 1.0f;
  bool Catchers = false;
  bool Gathers = false;
  int Behind = 0;
  bool Mirrored = false;
};
}

#endif
