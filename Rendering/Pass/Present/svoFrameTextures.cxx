#include "svoFrameTextures.h"

#include "svoFrameCopy.h"
#include "svoOpenGL.h"
#include "svoTileRuns.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <utility>

namespace svo
{
namespace
{
struct Image
{
  const char* sampler; // in svoPresentFS.glsl
  int components;
  GLenum format;
  unsigned int FrameImages::*name;
  std::vector<float> Frame::*values; // null: Frame::color
};
/// By FrameTextures::Textures.
constexpr Image Images[] = {
  { "colors", 4, GL_RGBA, &FrameImages::color, nullptr },
  { "depths", 1, GL_RED, &FrameImages::depth, &Frame::depth },
  { "normals", 3, GL_RGB, &FrameImages::normals, &Frame::normals },
  { "slopes", 2, GL_RG, &FrameImages::slopes, &Frame::slopes },
  { "light", 3, GL_RGB, &FrameImages::light, &Frame::light },
};

/// A texture for the frame's size. Returns true if it was made anew, since that has changed: it has
/// to be allocated then.
bool prepare(vtkSmartPointer<vtkTextureObject>& texture, vtkOpenGLRenderWindow* window,
  unsigned int width, unsigned int height)
{
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

bool FrameTextures::show(
  Frame& frame, const SilhouetteFinder& silhouettes, bool first, vtkOpenGLRenderWindow* window)
{
  std::vector<glm::vec2> positions = samplePositions();
  int viewport[4];
  window->GetState()->vtkglGetIntegerv(GL_VIEWPORT, viewport);
  const bool may = first && !this->CannotCopy && frame.width == viewport[2] &&
    frame.height == viewport[3] && !frame.onGPU() && !frame.hasNormals() && !frame.hasLight();
  const DepthFormat copies = may ? formatForCopies() : DepthFormat::None;
  bool others = false;
  if (frame.version == 0 || this->Shown != frame.version || positions != this->SamplePositions ||
    copies != this->Copies || !this->isOf(window))
  {
    this->SamplePositions = std::move(positions);
    this->uploadAll(frame, silhouettes, copies, window);
    this->Shown = frame.version;
    others = true;
  }
  if (!this->Copied.empty() &&
    !copyRectangles(this->colors(), this->DepthCopy, this->Copies, this->Copied))
  {
    this->CannotCopy = true;
    this->uploadAll(frame, silhouettes, DepthFormat::None, window);
    others = true;
  }
  return others;
}

void FrameTextures::uploadAll(
  Frame& frame, const SilhouetteFinder& find, DepthFormat copies, vtkOpenGLRenderWindow* window)
{
  Silhouettes silhouettes;
  if (this->bySamples() && find)
  {
    find(this->SamplePositions, silhouettes);
  }
  this->Parts.upload(silhouettes.parts);
  silhouettes.exchange(frame);
  TileRuns runs = tileRunsOf(frame);
  this->Drawn = std::move(runs.mixed);
  this->Copied = std::move(runs.whole);
  if (copies == DepthFormat::None)
  {
    this->Drawn.insert(this->Drawn.end(), this->Copied.begin(), this->Copied.end());
    this->Copied.clear();
  }
  // Pixels that are exchanged are not what the tracer wrote.
  if (this->HasParts || !silhouettes.pixels.empty())
  {
    this->Sent = 0;
  }
  this->HasParts = !silhouettes.pixels.empty();
  this->upload(frame, copies, window);
  silhouettes.exchange(frame); // back
}

void FrameTextures::release()
{
  this->Textures = {};
  this->DepthCopy = nullptr;
  this->Parts.release();
  this->Sent = this->Shown = 0;
}

bool FrameTextures::isOf(vtkOpenGLRenderWindow* window) const
{
  return this->colors() && this->colors()->GetContext() == window;
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
  this->DepthCopy = nullptr;
  this->Sent = 0;
  for (std::size_t i = 0; i < this->Textures.size(); ++i)
  {
    this->Textures[i] = nullptr;
    if (const unsigned int name = images.*Images[i].name)
    {
      this->Textures[i] = vtkSmartPointer<vtkTextureObject>::New();
      this->Textures[i]->SetContext(window);
      this->Textures[i]->AssignToExistingTexture(name, GL_TEXTURE_2D);
    }
  }
}

void FrameTextures::activate(vtkShaderProgram* program)
{
  for (std::size_t i = 0; i < this->Textures.size(); ++i)
  {
    if (vtkTextureObject* texture = this->Textures[i])
    {
      texture->Activate();
      program->SetUniformi(Images[i].sampler, texture->GetTextureUnit());
    }
  }
}

void FrameTextures::deactivate()
{
  for (vtkTextureObject* texture : this->Textures)
  {
    if (texture)
    {
      texture->Deactivate();
    }
  }
}

void FrameTextures::upload(const Frame& frame, DepthFormat format, vtkOpenGLRenderWindow* window)
{
  if (frame.onGPU())
  {
    this->Copies = format;
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
  const auto width = static_cast<unsigned int>(frame.width);
  const auto height = static_cast<unsigned int>(frame.height);
  for (std::size_t i = 0; i < this->Textures.size(); ++i)
  {
    const Image& image = Images[i];
    const bool has = !image.values || !(frame.*image.values).empty();
    this->Textures[i] = has ? this->Textures[i] : nullptr;
    if (has && prepare(this->Textures[i], window, width, height))
    {
      this->Textures[i]->Allocate2D(
        width, height, image.components, image.values ? VTK_FLOAT : VTK_UNSIGNED_CHAR);
      anew = true;
    }
  }
  if (copies && prepare(this->DepthCopy, window, width, height))
  {
    format == DepthFormat::Bits24
      ? this->DepthCopy->AllocateDepthStencil(width, height)
      : this->DepthCopy->AllocateDepth(width, height, vtkTextureObject::Fixed32);
    anew = true;
  }
  constexpr int Band = 8 * Frame::TileSize; // rows
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
    send(this->colors(), all, GL_RGBA, GL_UNSIGNED_BYTE, frame.color.data() + 4 * at(all),
      frame.width);
    if (!written.copied.empty())
    {
      this->sendDepthCopy(frame, written.copied);
    }
    const PixelRect& drawn = written.drawn;
    for (std::size_t i = 1; i < this->Textures.size() && !drawn.empty(); ++i)
    {
      const Image& image = Images[i];
      if (this->Textures[i])
      {
        send(this->Textures[i], drawn, image.format, GL_FLOAT,
          (frame.*image.values).data() + image.components * at(drawn), frame.width);
      }
    }
  }
  this->Sent = frame.version;
}
}
