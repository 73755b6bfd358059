#include "svoBorrowedTextures.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <cassert>

namespace svo
{
void BorrowedTextures::update(
  vtkOpenGLRenderWindow* window, const std::vector<ShaderValues::Texture>& textures)
{
  this->Samplers.clear();
  this->Textures.resize(textures.size());
  for (std::size_t i = 0; i < textures.size(); ++i)
  {
    vtkSmartPointer<vtkTextureObject>& texture = this->Textures[i];
    const auto& [sampler, name, target] = textures[i];
    assert(name != 0);
    this->Samplers.push_back(sampler);
    // OpenGL gives names again, also to textures of another target.
    if (!texture || texture->GetContext() != window || texture->GetHandle() != name ||
      texture->GetTarget() != target)
    {
      texture = vtkSmartPointer<vtkTextureObject>::New();
      texture->SetContext(window);
      texture->SetAutoParameters(0); // it has its own; VTK's assertions know no arrays of textures
      texture->AssignToExistingTexture(name, target);
    }
  }
}

void BorrowedTextures::release()
{
  this->Samplers.clear();
  this->Textures.clear();
}

void BorrowedTextures::activate()
{
  for (vtkTextureObject* texture : this->Textures)
  {
    texture->Activate();
  }
}

void BorrowedTextures::deactivate()
{
  for (vtkTextureObject* texture : this->Textures)
  {
    texture->Deactivate();
  }
}

void BorrowedTextures::send(vtkShaderProgram* program) const
{
  for (std::size_t i = 0; i < this->Textures.size(); ++i)
  {
    this->Textures[i]->Activate(); // mappers' own textures may have taken the unit meanwhile
    program->SetUniformi(this->Samplers[i], this->Textures[i]->GetTextureUnit());
  }
}
}
