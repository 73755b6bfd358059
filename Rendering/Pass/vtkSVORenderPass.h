/**
 * @class vtkSVORenderPass
 * @brief traces octrees inside an ordinary frame
 */
#ifndef vtkSVORenderPass_h
#define vtkSVORenderPass_h

#include "vtkOpenGLRenderPass.h"
#include "vtkSVOPassModule.h"

class VTKSVOPASS_EXPORT vtkSVORenderPass : public vtkOpenGLRenderPass
{
public:
  static vtkSVORenderPass* New();
  vtkTypeMacro(vtkSVORenderPass, vtkOpenGLRenderPass);
  void Render(const vtkRenderState* state) override;

protected:
  vtkSVORenderPass();
  ~vtkSVORenderPass() override;

private:
  vtkSVORenderPass(const vtkSVORenderPass&) = delete;
  void operator=(const vtkSVORenderPass&) = delete;
};

#endif
