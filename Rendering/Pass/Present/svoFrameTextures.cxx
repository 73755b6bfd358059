#include "svoFrameTextures.h"

#include "svoFrameCopy.h"
#include "svoOpenGL.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cassert>

namespace svo
{
namespace
{
enum class Kind
{
  Bytes, // of RGBA
  Float,
  TwoFloats,
  ThreeFloats,
  Depth,       // as a depth buffer of 32 bits has it,
  DepthStencil // or one of 24
};

/// A texture of the frame's size, made anew only when that changes; returns true if it was.
bool prepare(vtkSmartPointer<vtkTextureObject>& texture, vtkOpenGLRenderWindow* window,
  const Frame& frame, Kind kind)
{
  const auto width = static_cast<unsigned int>(frame.width);
  const auto height = static_cast<unsigned int>(frame.height);
  if (texture && texture->GetContext() == window && texture->GetWidth() == width &&
    texture->GetHeight() == height)
  {
    return false;
  }
  texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  texture->SetMinificationFilter(vtkTextureObject::Nearest);
  texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  switch (kind)
  {
    case Kind::Bytes:
      texture->Allocate2D(width, height, 4, VTK_UNSIGNED_CHAR);
      break;
    case Kind::Depth:
      texture->AllocateDepth(width, height, vtkTextureObject::Fixed32);
      break;
    case Kind::DepthStencil:
      texture->AllocateDepthStencil(width, height);
      break;
    default:
      texture->Allocate2D(width, height,
        kind == Kind::Float         ? 1
          : kind == Kind::TwoFloats ? 2
                                    : 3,
        VTK_FLOAT);
  }
  return true;
}

/// Sends a rectangle; `pixels`: of its lower left corner, in rows of `width`. VTK knows the
/// alignment that it has set, and relies on the row length being 0.
void send(vtkTextureObject* texture, const PixelRect& rect, GLenum format, GLenum type,
  const void* pixels, int width)
{
  texture->Bind();
  texture->GetContext()->GetState()->vtkglPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, width);
  glTexSubImage2D(
    GL_TEXTURE_2D, 0, rect.x0, rect.y0, rect.x1 - rect.x0, rect.y1 - rect.y0, format, type, pixels);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

/// The tiles of a band that were written after version `since`.
struct Written
{
  PixelRect copied, drawn; // around them
};
Written writtenIn(const Frame& frame, int y0, int y1, std::uint64_t since, bool copies)
{
  constexpr int Size = Frame::TileSize;
  Written written;
  if (frame.tiles.empty())
  {
    written.drawn = { frame.covered.x0, y0, frame.covered.x1, y1 };
    return written;
  }
  const int tilesX = (frame.width + Size - 1) / Size;
  for (int y = y0; y < y1; y += Size)
  {
    for (int x = frame.covered.x0; x < frame.covered.x1; x += Size)
    {
      const FrameTile& tile = frame.tiles[static_cast<std::size_t>(y / Size) * tilesX + x / Size];
      if (tile.kind == FrameTile::Kind::Empty || tile.version <= since)
      {
        continue;
      }
      PixelRect& rect =
        copies && tile.kind == FrameTile::Kind::Whole ? written.copied : written.drawn;
      rect =
        around(rect, { x, y, std::min(x + Size, frame.width), std::min(y + Size, frame.height) });
    }
  }
  return written;
}
}

void FrameTextures::release()
{
  this->Colors = this->Depths = this->DepthCopy = this->Normals = this->Slopes = this->Light =
    nullptr;
  this->Sent = 0;
}

bool FrameTextures::isOf(vtkOpenGLRenderWindow* window) const
{
  return this->Colors && this->Colors->GetContext() == window;
}

/// Converted band by band, so that the words are in the cache when they are sent.
void FrameTextures::sendDepthCopy(const Frame& frame, const PixelRect& rect)
{
  const std::size_t width = rect.x1 - rect.x0;
  this->DepthWords.resize(width * (rect.y1 - rect.y0));
  for (int y = rect.y0; y < rect.y1; ++y)
  {
    toDepthBuffer(frame.depth.data() + static_cast<std::size_t>(y) * frame.width + rect.x0, width,
      this->Copies, this->DepthWords.data() + (y - rect.y0) * width);
  }
  const bool stencil = this->Copies == DepthFormat::Bits24;
  send(this->DepthCopy, rect, stencil ? GL_DEPTH_STENCIL : GL_DEPTH_COMPONENT,
    stencil ? GL_UNSIGNED_INT_24_8 : GL_UNSIGNED_INT, this->DepthWords.data(), 0);
}

void FrameTextures::borrow(const FrameImages& images, vtkOpenGLRenderWindow* window)
{
  const auto wrap = [window](vtkSmartPointer<vtkTextureObject>& texture, unsigned int name)
  {
    texture = name != 0 ? vtkSmartPointer<vtkTextureObject>::New() : nullptr;
    if (texture)
    {
      texture->SetContext(window);
      texture->AssignToExistingTexture(name, GL_TEXTURE_2D);
    }
  };
  this->release();
  wrap(this->Colors, images.color);
  wrap(this->Depths, images.depth);
  wrap(this->Normals, images.normals);
  wrap(this->Slopes, images.slopes);
  wrap(this->Light, images.light);
}

void FrameTextures::upload(const Frame& frame, DepthFormat format, vtkOpenGLRenderWindow* window)
{
  if (frame.onGPU())
  {
    this->borrow(frame.images, window);
    return;
  }
  const bool copies = format != DepthFormat::None;
  bool anew = format != this->Copies || frame.version < this->Sent;
  if (format != this->Copies)
  {
    this->DepthCopy = nullptr;
    this->Copies = format;
  }
  constexpr int Band = 8 * Frame::TileSize; // rows
  anew |= prepare(this->Colors, window, frame, Kind::Bytes);
  anew |= prepare(this->Depths, window, frame, Kind::Float);
  anew |= copies &&
    prepare(this->DepthCopy, window, frame,
      format == DepthFormat::Bits24 ? Kind::DepthStencil : Kind::Depth);
  const auto prepareIf = [&](bool has, vtkSmartPointer<vtkTextureObject>& texture, Kind kind)
  {
    texture = has ? texture : nullptr;
    return has && prepare(texture, window, frame, kind);
  };
  anew |= prepareIf(frame.hasNormals(), this->Normals, Kind::ThreeFloats);
  anew |= prepareIf(frame.hasSlopes(), this->Slopes, Kind::TwoFloats);
  anew |= prepareIf(frame.hasLight(), this->Light, Kind::ThreeFloats);
  const std::uint64_t since = anew ? 0 : this->Sent;
  for (int y = frame.covered.y0; y < frame.covered.y1; y += Band)
  {
    const Written written =
      writtenIn(frame, y, std::min(y + Band, frame.covered.y1), since, copies);
    const PixelRect all = around(written.copied, written.drawn);
    const auto at = [&](const PixelRect& r)
    { return static_cast<std::size_t>(r.y0) * frame.width + r.x0; };
    if (all.empty())
    {
      continue;
    }
    send(
      this->Colors, all, GL_RGBA, GL_UNSIGNED_BYTE, frame.color.data() + 4 * at(all), frame.width);
    if (!written.copied.empty())
    {
      this->sendDepthCopy(frame, written.copied);
    }
    const PixelRect& drawn = written.drawn;
    if (drawn.empty())
    {
      continue;
    }
    send(this->Depths, drawn, GL_RED, GL_FLOAT, frame.depth.data() + at(drawn), frame.width);
    if (!frame.normals.empty())
    {
      send(
        this->Normals, drawn, GL_RGB, GL_FLOAT, frame.normals.data() + 3 * at(drawn), frame.width);
    }
    if (!frame.slopes.empty())
    {
      send(this->Slopes, drawn, GL_RG, GL_FLOAT, frame.slopes.data() + 2 * at(drawn), frame.width);
    }
    if (!frame.light.empty())
    {
      send(this->Light, drawn, GL_RGB, GL_FLOAT, frame.light.data() + 3 * at(drawn), frame.width);
    }
  }
  this->Sent = frame.version;
}
}
