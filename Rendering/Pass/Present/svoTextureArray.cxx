#include "svoTextureArray.h"

#include "svoOpenGL.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"

namespace svo
{
vtkStandardNewMacro(TextureArray);

int TextureArray::mostLayers()
{
  GLint layers = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
  return layers;
}

bool TextureArray::fits(vtkOpenGLRenderWindow* window, int size, int layers)
{
  return this->Handle && this->Context == window &&
    this->Width == static_cast<unsigned int>(size) &&
    this->Depth == static_cast<unsigned int>(layers);
}

bool TextureArray::allocate(int size, int layers)
{
  if (this->fits(this->Context, size, layers))
  {
    return true;
  }
  this->Target = GL_TEXTURE_2D_ARRAY;
  this->Components = 1;
  this->Width = this->Height = static_cast<unsigned int>(size);
  this->Depth = static_cast<unsigned int>(layers);
  this->NumberOfDimensions = 2;
  this->SetMinificationFilter(vtkTextureObject::Nearest);
  this->SetMagnificationFilter(vtkTextureObject::Nearest);
  this->SetWrapS(vtkTextureObject::ClampToEdge);
  this->SetWrapT(vtkTextureObject::ClampToEdge);
  // CreateTexture() sends them; later on VTK asserts that it knows arrays.
  this->AutoParametersOff();
  this->CreateTexture();
  this->Activate();
  for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) // errors of others
  {
  }
  glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_R32F, size, size, layers, 0, GL_RED, GL_FLOAT, nullptr);
  const bool made = glGetError() == GL_NO_ERROR;
  this->Deactivate();
  return made;
}

void TextureArray::send(int layer, const float* texels)
{
  const auto size = static_cast<GLsizei>(this->Width);
  this->Activate();
  this->Context->GetState()->vtkglPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, size, size, 1, GL_RED, GL_FLOAT, texels);
}
}
