#include "vtkSVORenderPass.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkSVORenderPass);

vtkSVORenderPass::vtkSVORenderPass() = default;
vtkSVORenderPass::~vtkSVORenderPass() = default;

void vtkSVORenderPass::Render(const vtkRenderState*) {}
