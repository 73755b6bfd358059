#include "svoReceiverProps.h"

#include "svoSceneCollector.h"

#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkNew.h"
#include "vtkOpenGLActor.h"
#include "vtkProp.h"
#include "vtkRenderState.h"
#include "vtkSmartPointer.h"

namespace svo
{
bool ReceiverProps::take(const vtkRenderState& drawn, const CollectedScene& collected)
{
  std::vector<std::pair<vtkProp*, vtkMTimeType>> props;
  for (int i = 0; i < drawn.GetPropArrayCount(); ++i)
  {
    vtkProp* prop = drawn.GetPropArray()[i];
    if (prop->GetVisibility() && collected.receivers.count(prop) > 0 &&
      collected.replaced.count(prop) == 0)
    {
      props.emplace_back(prop, prop->GetRedrawMTime());
    }
  }
  const bool same = props == this->Props;
  this->Props = props;
  return same;
}

void ReceiverProps::draw(vtkViewport* viewport, bool translucent) const
{
  const auto props = this->Props; // whoever hears of drawing may draw another frame
  for (const auto& [prop, time] : props)
  {
    if (!translucent)
    {
      prop->RenderOpaqueGeometry(viewport);
    }
    else if (prop->HasTranslucentPolygonalGeometry())
    {
      // Whoever hears of drawing may give it others.
      const vtkSmartPointer<vtkInformation> keys = prop->GetPropertyKeys();
      vtkInformationIntegerKey* writesDepth = vtkOpenGLActor::GLDepthMaskOverride();
      vtkNew<vtkInformation> before;
      before->CopyEntry(keys, writesDepth);
      keys->Set(writesDepth, 1);
      prop->RenderTranslucentPolygonalGeometry(viewport);
      keys->CopyEntry(before, writesDepth); // none if it had none
    }
  }
}
}
