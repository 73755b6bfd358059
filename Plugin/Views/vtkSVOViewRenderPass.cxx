#include "vtkSVOViewRenderPass.h"

#include "vtkCollectionRange.h"
#include "vtkLightCollection.h"
#include "vtkLightKit.h"
#include "vtkObjectFactory.h"
#include "vtkPVLight.h"
#include "vtkPVRenderView.h"
#include "vtkRenderer.h"

#include <utility>

vtkStandardNewMacro(vtkSVOViewRenderPass);

vtkSVOViewRenderPass::vtkSVOViewRenderPass()
{
  // ParaView hands no property over that has its default value.
  this->SetParaViewDefaults();
}

vtkSVOViewRenderPass::~vtkSVOViewRenderPass() = default;

void vtkSVOViewRenderPass::SetView(vtkPVRenderView* view)
{
  this->View = view;
}

/// In the words of the Light Inspector.
std::string vtkSVOViewRenderPass::NameOf(vtkLight* light) const
{
  // Both know, but tell their subclasses only.
  struct AskingView : public vtkPVRenderView
  {
    using vtkPVRenderView::LightKit;
  };
  struct AskingKit : public vtkLightKit
  {
    using vtkLightKit::BackLight0;
    using vtkLightKit::BackLight1;
    using vtkLightKit::FillLight;
    using vtkLightKit::HeadLight;
    using vtkLightKit::KeyLight;
  };
  vtkPVRenderView* view = this->View;
  if (!view)
  {
    return std::string();
  }
  const vtkLightKit* kit = view->*(&AskingView::LightKit);
  const std::pair<vtkLight * vtkLightKit::*, const char*> parts[] = { { &AskingKit::KeyLight,
                                                                        "Key light" },
    { &AskingKit::FillLight, "Fill light" }, { &AskingKit::BackLight0, "Back light" },
    { &AskingKit::BackLight1, "Back light" }, { &AskingKit::HeadLight, "Head light" } };
  for (const auto& [part, name] : parts)
  {
    if (kit->*part == light)
    {
      return name;
    }
  }
  int number = 0; // of those that were added
  for (vtkLight* other : vtk::Range(view->GetRenderer()->GetLights()))
  {
    if (other == light)
    {
      return "Light " + std::to_string(number);
    }
    number += other->IsA("vtkPVLight");
  }
  return std::string();
}

std::string vtkSVOViewRenderPass::GetText(int text, vtkLight* about) const
{
  switch (text)
  {
    case TEXT_HEADLIGHT:
      // For the rasteriser ParaView makes a headlight of an ambient light, and nothing tells them
      // apart. The light kit's own is another class.
      return vtkPVLight::SafeDownCast(about) ? "headlight or ambient light" : "headlight";
    case TEXT_LIGHT:
      return this->NameOf(about);
    case TEXT_ONLY_HEADLIGHTS:
      return "No shadows: the only lights are headlights or ambient ones, which cast none that can "
             "be seen. Switch the light kit on, or add a light: Light Inspector, Add Light.";
    case TEXT_TRANSLUCENT_SURFACE:
      return std::string(); // a window for each opacity that is lowered would be too much
    case TEXT_TRANSLUCENT:
      return "A surface, or some cells of it, cast no shadow because colours or texture make them "
             "translucent. SVO Translucent Shadows, of the view, has what colours make translucent "
             "cast as light as it is; Cast Shadows, of the surface's properties, switches the "
             "others' shadow and this message off.";
    case TEXT_CUT_OUT:
      return "A surface casts the shadow of its whole cells although its texture hides parts of "
             "them. Cast Shadows, of the surface's properties, switches the shadow off.";
    case TEXT_NOT_CHOSEN:
      return "is not shown as SVO";
    case TEXT_NOTHING_CASTS:
      return "No shadows: nothing casts any, and SVO Reasons, of the view, says why. ";
    default:
      return this->Superclass::GetText(text, about);
  }
}

void vtkSVOViewRenderPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ShadowGround: " << this->ShadowGround << '\n';
}
