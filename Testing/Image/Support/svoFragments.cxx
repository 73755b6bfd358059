#include "svoFragments.h"

#include "vtkNew.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkPixelBufferObject.h"
#include "vtkShaderProgram.h"
#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

namespace svotest
{
bool drawFragments(vtkOpenGLRenderWindow* window, int size,
  const std::vector<std::vector<FourFloats>>& inputs, const std::string& declarations,
  const std::string& main, const std::function<void(vtkShaderProgram*)>& prepare)
{
  std::string text = "//VTK::System::Dec\n//VTK::Output::Dec\nin vec2 texCoord;\n";
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    text += "uniform sampler2D input" + std::to_string(i) + ";\n";
  }
  text += declarations + "void main()\n{\n  ivec2 at = ivec2(texCoord * " + std::to_string(size) +
    ".0);\n" + main + "}\n";

  std::vector<vtkSmartPointer<vtkTextureObject>> textures;
  for (const std::vector<FourFloats>& input : inputs)
  {
    textures.push_back(vtkSmartPointer<vtkTextureObject>::New());
    textures.back()->SetContext(window);
    textures.back()->SetMinificationFilter(vtkTextureObject::Nearest);
    textures.back()->SetMagnificationFilter(vtkTextureObject::Nearest);
    textures.back()->Create2DFromRaw(
      size, size, 4, VTK_FLOAT, const_cast<float*>(input.front().data()));
  }
  vtkOpenGLQuadHelper quad(window, nullptr, text.c_str(), nullptr);
  const bool made = quad.Program && quad.Program->GetCompiled();
  if (made)
  {
    window->GetShaderCache()->ReadyShaderProgram(quad.Program);
    prepare(quad.Program);
    for (std::size_t i = 0; i < textures.size(); ++i)
    {
      textures[i]->Activate();
      quad.Program->SetUniformi(
        ("input" + std::to_string(i)).c_str(), textures[i]->GetTextureUnit());
    }
    quad.Render();
    for (const auto& texture : textures)
    {
      texture->Deactivate();
    }
  }
  quad.ReleaseGraphicsResources(window);
  return made;
}

std::vector<FourFloats> runFragments(vtkOpenGLRenderWindow* window, int size,
  const std::vector<std::vector<FourFloats>>& inputs, const std::string& declarations,
  const std::string& main, const std::function<void(vtkShaderProgram*)>& prepare)
{
  std::vector<FourFloats> result;
  vtkNew<vtkOpenGLFramebufferObject> target;
  target->SetContext(window);
  window->GetState()->PushFramebufferBindings();
  target->PopulateFramebuffer(size, size, true, 1, VTK_FLOAT, false, 24, 0);
  target->Bind();
  target->ActivateDrawBuffer(0);
  target->ActivateReadBuffer(0);
  target->Start(size, size);
  if (drawFragments(window, size, inputs, declarations, main, prepare))
  {
    int extent[4] = { 0, size - 1, 0, size - 1 };
    const auto pixels =
      vtkSmartPointer<vtkPixelBufferObject>::Take(target->DownloadColor4(extent, VTK_FLOAT));
    unsigned int dims[2] = { static_cast<unsigned int>(size), static_cast<unsigned int>(size) };
    vtkIdType increments[2] = { 0, 0 };
    result.resize(static_cast<std::size_t>(size) * size);
    pixels->Download2D(VTK_FLOAT, result.front().data(), dims, 4, increments);
  }
  target->ReleaseGraphicsResources(window);
  window->GetState()->PopFramebufferBindings();
  return result;
}
}
