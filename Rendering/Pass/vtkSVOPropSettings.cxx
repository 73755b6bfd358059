#include "vtkSVOPropSettings.h"

#include "svoPropKeys.h"
#include "svoSceneCollector.h"
#include "svoSceneLights.h"

#include "vtkActor.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleKey.h"
#include "vtkInformationIntegerKey.h"
#include "vtkLight.h"
#include "vtkProp.h"

#include <algorithm>
#include <cmath>

vtkInformationIntegerKey* vtkSVOPropSettings::CAST_SHADOW()
{
  return svo::castShadowKey();
}

vtkInformationIntegerKey* vtkSVOPropSettings::RECEIVE_SHADOW()
{
  return svo::receiveShadowKey();
}

vtkInformationIntegerKey* vtkSVOPropSettings::USE_SVO()
{
  return svo::useSVOKey();
}

vtkInformationIntegerKey* vtkSVOPropSettings::SHADOW_CATCHER()
{
  return svo::shadowCatcherKey();
}

vtkInformationDoubleKey* vtkSVOPropSettings::PIXEL_ERROR()
{
  return svo::pixelErrorKey();
}

vtkInformationDoubleKey* vtkSVOPropSettings::LIGHT_SIZE()
{
  return svo::lightSizeKey();
}

void vtkSVOPropSettings::SetCastShadow(bool cast, vtkProp* prop)
{
  svo::setFlag(prop, svo::castShadowKey(), cast);
}

bool vtkSVOPropSettings::GetCastShadow(vtkProp* prop)
{
  if (!prop)
  {
    return false;
  }
  const svo::PropSurfaces judged = svo::SceneCollector().judge(prop);
  // Nothing to be seen yet is no reason.
  return judged.casts() ||
    (!judged.castsNone && svo::flagOf(prop, nullptr, svo::castShadowKey(), true));
}

std::string vtkSVOPropSettings::GetReason(vtkProp* prop)
{
  if (!prop)
  {
    return {};
  }
  const svo::PropSurfaces judged = svo::SceneCollector().judge(prop);
  return svo::reasons(judged.rasterized, judged.castsNone, judged.casts());
}

void vtkSVOPropSettings::SetCastShadow(bool cast, vtkLight* light)
{
  if (light)
  {
    svo::keysOf(light)->Set(CAST_SHADOW(), cast ? 1 : 0);
    light->Modified();
  }
}

bool vtkSVOPropSettings::GetCastShadow(vtkLight* light)
{
  return light && light->GetSwitch() && svo::castsShadow(light);
}

void vtkSVOPropSettings::SetLightSize(double size, vtkLight* light)
{
  if (!(size >= 0.0) || !std::isfinite(size))
  {
    vtkGenericWarningMacro(
      "A light's size stays " << GetLightSize(light) << ": " << size << " is no radius or angle.");
  }
  else if (light && size != GetLightSize(light))
  {
    svo::keysOf(light)->Set(LIGHT_SIZE(), size);
    light->Modified();
  }
}

double vtkSVOPropSettings::GetLightSize(vtkLight* light)
{
  return light ? svo::lightSizeOf(light) : 0.0;
}

void vtkSVOPropSettings::SetReceiveShadow(bool receive, vtkProp* prop)
{
  svo::setFlag(prop, svo::receiveShadowKey(), receive);
}

bool vtkSVOPropSettings::GetReceiveShadow(vtkProp* prop)
{
  return svo::flagOf(prop, nullptr, svo::receiveShadowKey(), true);
}

void vtkSVOPropSettings::SetShadowCatcher(bool catches, vtkProp* prop)
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

bool vtkSVOPropSettings::GetShadowCatcher(vtkProp* prop)
{
  return svo::flagOf(prop, nullptr, svo::shadowCatcherKey(), false);
}

void vtkSVOPropSettings::SetUseSVO(bool use, vtkProp* prop)
{
  svo::setFlag(prop, svo::useSVOKey(), use);
}

bool vtkSVOPropSettings::GetUseSVO(vtkProp* prop)
{
  return svo::flagOf(prop, nullptr, svo::useSVOKey(), true);
}

void vtkSVOPropSettings::SetPropPixelError(double error, vtkProp* prop)
{
  if (std::isnan(error))
  {
    vtkGenericWarningMacro("A prop's pixel error stays " << GetPropPixelError(prop)
                                                         << ": the value given is not a number.");
  }
  else if (prop)
  {
    svo::keysOf(prop)->Set(PIXEL_ERROR(), error >= 0.0 ? std::min(error, 64.0) : -1.0);
  }
}

double vtkSVOPropSettings::GetPropPixelError(vtkProp* prop)
{
  return svo::pixelErrorOf(prop, nullptr);
}
