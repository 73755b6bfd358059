#include "svoReceiverProps.h"

#include "svoSceneCollector.h"

#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkOpenGLActor.h"
#include "vtkProp.h"
#include "vtkRenderState.h"
#include "vtkSmartPointer.h"

namespace svo
{
namespace
{
/// Has a translucent prop, which has keys, write depths while it is drawn.
class WritesDepth
{
public:
  explicit WritesDepth(vtkProp* prop)
    : Keys(prop->GetPropertyKeys())
    , Had(this->Keys->Has(key()))
    , Before(this->Had ? this->Keys->Get(key()) : 0)
  {
    this->Keys->Set(key(), 1);
  }
  ~WritesDepth() { this->Had ? this->Keys->Set(key(), this->Before) : this->Keys->Remove(key()); }
  WritesDepth(const WritesDepth&) = delete;
  WritesDepth& operator=(const WritesDepth&) = delete;

private:
  static vtkInformationIntegerKey* key() { return vtkOpenGLActor::GLDepthMaskOverride(); }

  vtkSmartPointer<vtkInformation> Keys; // whoever hears of drawing may give it others
  bool Had;
  int Before;
};
}

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
      const WritesDepth depth(prop);
      prop->RenderTranslucentPolygonalGeometry(viewport);
    }
  }
}
}
