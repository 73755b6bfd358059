#include "svoEarlierViews.h"

#include "vtkCollection.h"
#include "vtkNew.h"
#include "vtkSMProxyManager.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSetGet.h"

namespace svo
{
void warnOfEarlierViews()
{
  vtkSMSessionProxyManager* proxies = vtkSMProxyManager::IsInitialized()
    ? vtkSMProxyManager::GetProxyManager()->GetActiveSessionProxyManager()
    : nullptr;
  if (!proxies)
  {
    return;
  }
  vtkNew<vtkCollection> views;
  proxies->GetProxies("views", views);
  for (int i = 0; i < views->GetNumberOfItems(); ++i)
  {
    auto* view = vtkSMRenderViewProxy::SafeDownCast(views->GetItemAsObject(i));
    if (view && !view->GetProperty("SVOShadowsForEverything"))
    {
      vtkGenericWarningMacro(
        "Views that are there already have no SVO settings. Edit > Reset Session "
        "makes one that has them; so has every view that is made from now on. "
        "Auto Load, in Tools > Manage Plugins, is early enough next time.");
      return;
    }
  }
}
}
