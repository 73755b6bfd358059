// The answers that props and lights carry themselves.
#include "vtkSVORenderPass.h"

#include "svoSceneCollector.h"
#include "svoSceneLights.h"

#include "vtkInformation.h"
#include "vtkInformationDoubleKey.h"
#include "vtkInformationIntegerKey.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkProp.h"

#include <algorithm>
#include <cmath>

vtkInformationKeyMacro(vtkSVORenderPass, CAST_SHADOW, Integer);
vtkInformationKeyMacro(vtkSVORenderPass, RECEIVE_SHADOW, Integer);
vtkInformationKeyMacro(vtkSVORenderPass, USE_SVO, Integer);
vtkInformationKeyMacro(vtkSVORenderPass, PIXEL_ERROR, Double);

namespace
{
vtkInformation* keysOf(vtkProp* prop)
{
  if (!prop->GetPropertyKeys())
  {
    vtkNew<vtkInformation> keys;
    prop->SetPropertyKeys(keys);
  }
  return prop->GetPropertyKeys();
}

void setFlag(vtkInformationIntegerKey* key, bool value, vtkProp* prop)
{
  if (prop)
  {
    keysOf(prop)->Set(key, value ? 1 : 0);
  }
}

bool flag(vtkInformationIntegerKey* key, vtkProp* prop, bool otherwise)
{
  vtkInformation* keys = prop ? prop->GetPropertyKeys() : nullptr;
  return keys && keys->Has(key) ? keys->Get(key) != 0 : otherwise;
}
}

void vtkSVORenderPass::SetCastShadow(bool cast, vtkProp* prop)
{
  setFlag(CAST_SHADOW(), cast, prop);
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
  return !judged.castsNone && flag(CAST_SHADOW(), prop, !prop->HasTranslucentPolygonalGeometry());
}

std::string vtkSVORenderPass::GetReason(vtkProp* prop)
{
  std::string text;
  if (prop)
  {
    const svo::PropSurfaces judged = svo::SceneCollector().judge(prop);
    if (judged.rasterized)
    {
      text += std::string("Left to the rasteriser: it ") + judged.rasterized + ".";
    }
    if (judged.castsNone)
    {
      text += (text.empty() ? "" : " ");
      text += judged.casts() ? "Casts less than its whole shadow: it " : "Casts no shadow: it ";
      text += std::string(judged.castsNone) + ".";
    }
  }
  return text;
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
  setFlag(RECEIVE_SHADOW(), receive, prop);
}

bool vtkSVORenderPass::GetReceiveShadow(vtkProp* prop)
{
  return flag(RECEIVE_SHADOW(), prop, true);
}

void vtkSVORenderPass::SetUseSVO(bool use, vtkProp* prop)
{
  setFlag(USE_SVO(), use, prop);
}

bool vtkSVORenderPass::GetUseSVO(vtkProp* prop)
{
  return flag(USE_SVO(), prop, true);
}

void vtkSVORenderPass::SetPropPixelError(double error, vtkProp* prop)
{
  if (std::isnan(error))
  {
    vtkGenericWarningMacro("A prop's pixel error stays " << GetPropPixelError(prop)
                                                         << ": the value given is not a number.");
  }
  else if (prop)
  {
    keysOf(prop)->Set(PIXEL_ERROR(), error >= 0.0 ? std::min(error, 64.0) : -1.0);
  }
}

double vtkSVORenderPass::GetPropPixelError(vtkProp* prop)
{
  vtkInformation* keys = prop ? prop->GetPropertyKeys() : nullptr;
  return keys && keys->Has(PIXEL_ERROR()) ? keys->Get(PIXEL_ERROR()) : -1.0;
}
