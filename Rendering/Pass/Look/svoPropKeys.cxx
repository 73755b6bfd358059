#include "svoPropKeys.h"

#include "vtkInformation.h"
#include "vtkInformationDoubleKey.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationKeyLookup.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkProp.h"

namespace svo
{
// They are known to scripts by this class's name.
vtkInformationIntegerKey* castShadowKey()
{
  static auto* key = vtkInformationIntegerKey::MakeKey("CAST_SHADOW", "vtkSVORenderPass");
  return key;
}

vtkInformationIntegerKey* receiveShadowKey()
{
  static auto* key = vtkInformationIntegerKey::MakeKey("RECEIVE_SHADOW", "vtkSVORenderPass");
  return key;
}

vtkInformationIntegerKey* useSVOKey()
{
  static auto* key = vtkInformationIntegerKey::MakeKey("USE_SVO", "vtkSVORenderPass");
  return key;
}

vtkInformationIntegerKey* shadowCatcherKey()
{
  static auto* key = vtkInformationIntegerKey::MakeKey("SHADOW_CATCHER", "vtkSVORenderPass");
  return key;
}

vtkInformationDoubleKey* pixelErrorKey()
{
  static auto* key = vtkInformationDoubleKey::MakeKey("PIXEL_ERROR", "vtkSVORenderPass");
  return key;
}

vtkInformationDoubleKey* lightSizeKey()
{
  static auto* key = vtkInformationDoubleKey::MakeKey("LIGHT_SIZE", "vtkSVORenderPass");
  return key;
}

bool flagOf(vtkProp* prop, vtkProp* owner, vtkInformationIntegerKey* key, bool otherwise)
{
  for (vtkProp* asked : { prop, owner })
  {
    vtkInformation* keys = asked ? asked->GetPropertyKeys() : nullptr;
    if (keys && keys->Has(key))
    {
      return keys->Get(key) != 0;
    }
  }
  return otherwise;
}

double pixelErrorOf(vtkProp* prop, vtkProp* owner)
{
  for (vtkProp* asked : { prop, owner })
  {
    vtkInformation* keys = asked ? asked->GetPropertyKeys() : nullptr;
    if (keys && keys->Has(pixelErrorKey()) && keys->Get(pixelErrorKey()) >= 0.0)
    {
      return keys->Get(pixelErrorKey());
    }
  }
  return -1.0;
}

PropAnswers answersOf(vtkProp* prop)
{
  PropAnswers answers(0, -1.0);
  vtkInformation* keys = prop->GetPropertyKeys();
  if (!keys)
  {
    return answers;
  }
  for (vtkInformationIntegerKey* key :
    { castShadowKey(), receiveShadowKey(), useSVOKey(), shadowCatcherKey() })
  {
    const unsigned int answer = !keys->Has(key) ? 0 : keys->Get(key) == 0 ? 1 : 2;
    answers.first = 3 * answers.first + answer;
  }
  if (keys->Has(pixelErrorKey()))
  {
    answers.second = keys->Get(pixelErrorKey());
  }
  return answers;
}

double lightSizeOf(vtkLight* light)
{
  // VTK may have been built without that backend, and has no such key then.
  auto* radius = vtkInformationDoubleKey::SafeDownCast(
    vtkInformationKeyLookup::Find("RADIUS", "vtkOSPRayLightNode"));
  vtkInformation* keys = light->GetInformation();
  for (vtkInformationDoubleKey* key : { lightSizeKey(), radius })
  {
    if (keys && key && keys->Has(key) && keys->Get(key) > 0.0)
    {
      return keys->Get(key);
    }
  }
  return 0.0;
}

vtkInformation* keysOf(vtkProp* prop)
{
  if (!prop->GetPropertyKeys())
  {
    prop->SetPropertyKeys(vtkNew<vtkInformation>());
  }
  return prop->GetPropertyKeys();
}

vtkInformation* keysOf(vtkLight* light)
{
  if (!light->GetInformation())
  {
    light->SetInformation(vtkNew<vtkInformation>());
  }
  return light->GetInformation();
}

void setFlag(vtkProp* prop, vtkInformationIntegerKey* key, bool value)
{
  if (prop)
  {
    keysOf(prop)->Set(key, value ? 1 : 0);
  }
}
}
