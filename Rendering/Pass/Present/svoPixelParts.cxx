#include "svoPixelParts.h"

#include "svoOpenGL.h"
#include "svoPixelPartFS.h"
#include "svoPixelPartVS.h"

#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkShaderProgram.h"

#include <cstddef>

namespace svo
{
std::vector<glm::vec2> samplePositions()
{
  GLint count = 0;
  glGetIntegerv(GL_SAMPLES, &count);
  std::vector<glm::vec2> positions;
  for (GLint i = 0; count > 1 && i < count && i < 32 && glIsEnabled(GL_MULTISAMPLE); ++i)
  {
    GLfloat at[2] = { 0.5f, 0.5f };
    glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(i), at);
    positions.emplace_back(at[0], at[1]);
  }
  return positions;
}

void PixelParts::upload(const std::vector<PixelPart>& parts)
{
  this->Runs.clear();
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    if (this->Runs.empty() || this->Runs.back().samples != parts[i].samples)
    {
      this->Runs.push_back({ parts[i].samples, static_cast<int>(i), 0 });
    }
    ++this->Runs.back().count;
  }
  if (parts.empty())
  {
    return;
  }
  if (!this->Buffer)
  {
    this->Buffer = vtkSmartPointer<vtkOpenGLBufferObject>::New();
    this->Array = vtkSmartPointer<vtkOpenGLVertexArrayObject>::New();
  }
  this->Buffer->Upload(parts, vtkOpenGLBufferObject::ArrayBuffer);
}

void PixelParts::release()
{
  this->Runs.clear();
  this->Buffer = nullptr;
  this->Array = nullptr;
}

bool PixelParts::draw(vtkOpenGLRenderWindow* window, const float frameSize[2])
{
  if (this->Runs.empty())
  {
    return true;
  }
  vtkShaderProgram* program =
    window->GetShaderCache()->ReadyShaderProgram(svoPixelPartVS, svoPixelPartFS, "");
  if (!program)
  {
    return false;
  }
  program->SetUniform2f("frameSize", frameSize);
  this->Array->Bind();
  constexpr std::size_t stride = sizeof(PixelPart);
  this->Array->AddAttributeArray(program, this->Buffer, "pixel",
    static_cast<int>(offsetof(PixelPart, x)), stride, VTK_UNSIGNED_SHORT, 2, false);
  this->Array->AddAttributeArray(program, this->Buffer, "depth",
    static_cast<int>(offsetof(PixelPart, depth)), stride, VTK_FLOAT, 1, false);
  this->Array->AddAttributeArray(program, this->Buffer, "color",
    static_cast<int>(offsetof(PixelPart, color)), stride, VTK_UNSIGNED_CHAR, 4, true);

  window->GetState()->vtkglPointSize(1.0f);
  glEnable(GL_SAMPLE_MASK); // vtkOpenGLState knows nothing of it
  for (const Run& run : this->Runs)
  {
    glSampleMaski(0, run.samples);
    glDrawArrays(GL_POINTS, run.first, run.count);
  }
  glSampleMaski(0, ~0u);
  glDisable(GL_SAMPLE_MASK);
  this->Array->Release();
  return true;
}
}
