// What is said when the plugin is loaded.
#ifndef svoEarlierViews_h
#define svoEarlierViews_h

#include "vtkSVOViewsModule.h" // for the export macro

namespace svo
{
/// Says what to do, if there are render views already: a view has the properties that ParaView
/// knew of when it was made, so these lack the plugin's. For clients; says nothing elsewhere.
VTKSVOVIEWS_EXPORT void warnOfEarlierViews();
}

#endif
