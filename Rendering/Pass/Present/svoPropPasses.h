// The passes that a prop carries in a frame (vtkOpenGLRenderPass::RenderPasses()).
#ifndef svoPropPasses_h
#define svoPropPasses_h

#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkProp.h"

namespace svo
{
/// Calls visit(pass) for them.
template <class Visit>
void eachPass(vtkProp* prop, const Visit& visit)
{
  vtkInformation* keys = prop->GetPropertyKeys();
  vtkInformationObjectBaseVectorKey* passes = vtkOpenGLRenderPass::RenderPasses();
  const int count = keys && keys->Has(passes) ? keys->Length(passes) : 0;
  for (int i = 0; i < count; ++i)
  {
    if (auto* pass = vtkOpenGLRenderPass::SafeDownCast(keys->Get(passes, i)))
    {
      visit(pass);
    }
  }
}
}

#endif
