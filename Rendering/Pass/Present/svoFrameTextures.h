// A frame's images as textures, and which rectangles of them are to be drawn. Only tiles that a
// tracer has written since the last upload are sent, band by band: in each the rectangle around
// them. Where software OpenGL copies pixels faster than it draws them, tiles without holes are.
#ifndef svoFrameTextures_h
#define svoFrameTextures_h

#include "svoFrame.h"
#include "svoFrameCopy.h"
#include "svoPixelParts.h"

#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;

namespace svo
{
class FrameTextures
{
public:
  /// Finds the parts of pixels that surfaces cover, for samples at these positions.
  using SilhouetteFinder = std::function<void(const std::vector<glm::vec2>&, Silhouettes&)>;

  /// Has a frame there, for the framebuffer that is bound. Of one that is on the GPU its own
  /// textures are taken. Where the framebuffer has several samples a pixel, silhouettes are asked
  /// for; the frame's pixels that they replace are exchanged meanwhile. `first`: nothing lies
  /// before the frame, so what can be copied is, into the viewport that is set. True if other
  /// rectangles than before are to be drawn.
  bool show(
    Frame& frame, const SilhouetteFinder& silhouettes, bool first, vtkOpenGLRenderWindow* window);
  /// Pixels to be drawn, with the textures activated. Those without hits in them are not defined.
  const std::vector<PixelRect>& rectangles() const { return this->Drawn; }
  /// True if the pixels' samples have depths of their own.
  bool bySamples() const { return !this->SamplePositions.empty(); }

  /// Activates those that the last frame has, copies of depths apart, and says so to a program of
  /// svoPresentFS.glsl, which is in use.
  void activate(vtkShaderProgram* program);
  /// Draws the parts of pixels on silhouettes after the rectangles; PixelParts::draw().
  bool drawParts(vtkOpenGLRenderWindow* window, const float frameSize[2])
  {
    return this->Parts.draw(window, frameSize);
  }
  void deactivate();
  void release();

private:
  bool isOf(vtkOpenGLRenderWindow* window) const;
  vtkTextureObject* colors() const { return this->Textures.front(); }
  void uploadAll(Frame& frame, const SilhouetteFinder& silhouettes, DepthFormat copies,
    vtkOpenGLRenderWindow* window);
  /// `copies`: unless none, tiles that are covered whole will be copied (svoFrameCopy.h), so of
  /// them depths are sent as such a depth buffer has them; of others, or of all, as floats.
  void upload(const Frame& frame, DepthFormat copies, vtkOpenGLRenderWindow* window);
  void borrow(const FrameImages& images, vtkOpenGLRenderWindow* window);
  void sendDepthCopy(const Frame& frame, const PixelRect& rect);

  std::uint64_t Shown = 0;                // Frame::version of all that is below
  std::vector<glm::vec2> SamplePositions; // of a pixel; none where it has one
  PixelParts Parts;
  bool HasParts = false;                // pixels were exchanged
  bool CannotCopy = false;              // OpenGL did not take it
  std::vector<PixelRect> Copied, Drawn; // rectangles of pixels
  std::uint64_t Sent = 0;               // Frame::version; 0: nothing, or not to be relied on
  DepthFormat Copies = DepthFormat::None;
  /// Colours, depths, normals, slopes, light.
  std::array<vtkSmartPointer<vtkTextureObject>, 5> Textures;
  vtkSmartPointer<vtkTextureObject> DepthCopy;
  std::vector<std::uint32_t> DepthWords; // of a band
};
}

#endif
