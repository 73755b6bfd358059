// The answers that props and lights carry themselves.
#include "vtkSVORenderPass.h"

#include "svoPropKeys.h"
#include "svoSceneCollector.h"
#include "svoSceneLights.h"

#include "vtkActor.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkProp.h"

#include <algorithm>
#include <cmath>

vtkInformationIntegerKey* vtkSVORenderPass::CAST_SHADOW()
{
  return svo::castShadowKey();
}

vtkInformationIntegerKey* vtkSVORenderPass::RECEIVE_SHADOW()
{
  return svo::receiveShadowKey();
}

vtkInformationIntegerKey* vtkSVORenderPass::USE_SVO()
{
  return svo::useSVOKey();
}

vtkInformationIntegerKey* vtkSVORenderPass::SHADOW_CATCHER()
{
  return svo::shadowCatcherKey();
}

vtkInformationDoubleKey* vtkSVORenderPass::PIXEL_ERROR()
{
  return svo::pixelErrorKey();
}

void vtkSVORenderPass::SetCastShadow(bool cast, vtkProp* prop)
{
  svo::setFlag(prop, svo::castShadowKey(), cast);
}

bool vtkSVORenderPass::GetCastShadow(vtkProp* prop)
{
  if (!prop)
  {
    return false;
  }
  const svo::PropSurfaces judged = svo::SceneCollector().judge(prop);
  if (judged.casts())
  {
    return true;
  }
  // Nothing to be seen yet is no reason.
  return !judged.castsNone && svo::flagOf(prop, nullptr, svo::castShadowKey(), true);
}

std::string vtkSVORenderPass::GetReason(vtkProp* prop)
{
  if (!prop)
  {
    return {};
  }
  const svo::PropSurfaces judged = svo::SceneCollector().judge(prop);
  return svo::reasons(judged.rasterized, judged.castsNone, judged.casts());
}

void vtkSVORenderPass::SetCastShadow(bool cast, vtkLight* light)
{
  if (!light)
  {
    return;
  }
  if (!light->GetInformation())
  {
    vtkNew<vtkInformation> keys;
    light->SetInformation(keys);
  }
  light->GetInformation()->Set(CAST_SHADOW(), cast ? 1 : 0);
  light->Modified();
}

bool vtkSVORenderPass::GetCastShadow(vtkLight* light)
{
  if (!light)
  {
    return false;
  }
  return light->GetSwitch() && svo::castsShadow(light);
}

void vtkSVORenderPass::SetReceiveShadow(bool receive, vtkProp* prop)
{
  svo::setFlag(prop, svo::receiveShadowKey(), receive);
}

bool vtkSVORenderPass::GetReceiveShadow(vtkProp* prop)
{
  return svo::flagOf(prop, nullptr, svo::receiveShadowKey(), true);
}

void vtkSVORenderPass::SetShadowCatcher(bool catches, vtkProp* prop)
{
  if (catches == GetShadowCatcher(prop))
  {
    return;
  }
  svo::setFlag(prop, svo::shadowCatcherKey(), catches);
  if (auto* actor = vtkActor::SafeDownCast(prop))
  {
    actor->SetForceTranslucent(catches);
  }
}

bool vtkSVORenderPass::GetShadowCatcher(vtkProp* prop)
{
  return svo::flagOf(prop, nullptr, svo::shadowCatcherKey(), false);
}

void vtkSVORenderPass::SetUseSVO(bool use, vtkProp* prop)
{
  svo::setFlag(prop, svo::useSVOKey(), use);
}

bool vtkSVORenderPass::GetUseSVO(vtkProp* prop)
{
  return svo::flagOf(prop, nullptr, svo::useSVOKey(), true);
}

void vtkSVORenderPass::SetPropPixelError(double error, vtkProp* prop)
{
  if (std::isnan(error))
  {
    vtkGenericWarningMacro("A prop's pixel error stays " << GetPropPixelError(prop)
                                                         << ": the value given is not a number.");
  }
  else
  {
    svo::setPixelError(prop, error >= 0.0 ? std::min(error, 64.0) : -1.0);
  }
}

double vtkSVORenderPass::GetPropPixelError(vtkProp* prop)
{
  return svo::pixelErrorOf(prop, nullptr);
}
