/**
 * @class vtkSVOForwardingPass
 * @brief does for shaders what another pass does, and does not keep it alive
 *
 * VTK's mappers hold the passes that they were drawn with. One that belongs to a pass would keep it
 * for ever.
 */
#ifndef vtkSVOForwardingPass_h
#define vtkSVOForwardingPass_h

#include "vtkOpenGLRenderPass.h"
#include "vtkWeakPointer.h"

#include <string>

class vtkSVOForwardingPass : public vtkOpenGLRenderPass
{
public:
  static vtkSVOForwardingPass* New();
  vtkTypeMacro(vtkSVOForwardingPass, vtkOpenGLRenderPass);

  vtkWeakPointer<vtkOpenGLRenderPass> Pass;

  void Render(const vtkRenderState*) override {}
  bool PreReplaceShaderValues(std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop) override
  {
    return !this->Pass ||
      this->Pass->PreReplaceShaderValues(
        vertexShader, geometryShader, fragmentShader, mapper, prop);
  }
  bool PostReplaceShaderValues(std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop) override
  {
    return !this->Pass ||
      this->Pass->PostReplaceShaderValues(
        vertexShader, geometryShader, fragmentShader, mapper, prop);
  }
  bool SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop,
    vtkOpenGLVertexArrayObject* array) override
  {
    return !this->Pass || this->Pass->SetShaderParameters(program, mapper, prop, array);
  }
  vtkMTimeType GetShaderStageMTime() override
  {
    return this->Pass ? this->Pass->GetShaderStageMTime() : 0;
  }

protected:
  vtkSVOForwardingPass() = default;
  ~vtkSVOForwardingPass() override = default;

private:
  vtkSVOForwardingPass(const vtkSVOForwardingPass&) = delete;
  void operator=(const vtkSVOForwardingPass&) = delete;
};

#endif
