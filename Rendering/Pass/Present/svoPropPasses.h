// The passes that a prop carries in a frame (vtkOpenGLRenderPass::RenderPasses()).
#ifndef svoPropPasses_h
#define svoPropPasses_h

#include "svoPropKeys.h"

#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkProp.h"
#include "vtkRenderState.h"

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

/// The last of the passes in keys. Not Append(): that adds a reference which only Remove() takes
/// away, once for all that are there.
inline void addPass(vtkInformation* keys, vtkOpenGLRenderPass* pass)
{
  vtkInformationObjectBaseVectorKey* passes = vtkOpenGLRenderPass::RenderPasses();
  keys->Set(passes, pass, keys->Has(passes) ? keys->Length(passes) : 0);
}

/// Has the props of a frame carry a pass, as vtkOpenGLRenderPass::PreRender() does. Of an actor
/// that is a part of an assembly as well keys are the assembly's from when that was drawn, and so
/// they are there twice; the references that PreRender() appends to its former ones, or to these,
/// stay.
inline void carryPass(const vtkRenderState* state, vtkOpenGLRenderPass* pass)
{
  for (int i = 0; i < state->GetPropArrayCount(); ++i)
  {
    addPass(keysOf(state->GetPropArray()[i]), pass);
  }
}

/// Takes it off.
inline void dropPass(const vtkRenderState* state, vtkOpenGLRenderPass* pass)
{
  vtkInformationObjectBaseVectorKey* passes = vtkOpenGLRenderPass::RenderPasses();
  for (int i = 0; i < state->GetPropArrayCount(); ++i)
  {
    vtkInformation* keys = state->GetPropArray()[i]->GetPropertyKeys();
    int left = 0;
    const int count = keys && keys->Has(passes) ? keys->Length(passes) : 0;
    for (int k = 0; k < count; ++k)
    {
      vtkObjectBase* one = keys->Get(passes, k);
      if (one != pass)
      {
        keys->Set(passes, one, left++);
      }
    }
    if (left < count)
    {
      passes->Resize(keys, left);
    }
    if (count > 0 && left == 0)
    {
      keys->Remove(passes);
    }
  }
}
}

#endif
