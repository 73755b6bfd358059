// A frame's images as textures. Only tiles that a tracer has written since the last upload are
// sent, band by band: in each the rectangle around them.
#ifndef svoFrameTextures_h
#define svoFrameTextures_h

#include "svoFrame.h"
#include "svoFrameCopy.h"

#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

#include <array>
#include <cstdint>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;

namespace svo
{
class FrameTextures
{
public:
  /// Of a frame that is on the GPU its own textures are taken. `copies`: unless none, tiles that
  /// are covered whole will be copied (svoFrameCopy.h), so of them depths are sent as such a depth
  /// buffer has them; of others, or of all, as floats.
  void upload(const Frame& frame, DepthFormat copies, vtkOpenGLRenderWindow* window);
  /// The next upload sends all tiles.
  void invalidate() { this->Sent = 0; }
  void release();

  bool isOf(vtkOpenGLRenderWindow* window) const;

  // Null where the last frame has none. Pixels of tiles without hits are not defined.
  vtkTextureObject* colors() const { return this->Textures.front(); }
  vtkTextureObject* depthCopy() const { return this->DepthCopy; }

  /// Activates those that the last frame has, copies of depths apart, and says so to a program of
  /// svoPresentFS.glsl, which is in use.
  void activate(vtkShaderProgram* program);
  void deactivate();

private:
  void borrow(const FrameImages& images, vtkOpenGLRenderWindow* window);
  void sendDepthCopy(const Frame& frame, const PixelRect& rect);

  std::uint64_t Sent = 0; // Frame::version; 0: nothing, or not to be relied on
  DepthFormat Copies = DepthFormat::None;
  /// Colours, depths, normals, slopes, light.
  std::array<vtkSmartPointer<vtkTextureObject>, 5> Textures;
  vtkSmartPointer<vtkTextureObject> DepthCopy;
  std::vector<std::uint32_t> DepthWords; // of a band
};
}

#endif
