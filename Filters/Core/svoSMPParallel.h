// The engine's executor on VTK's threads.
#ifndef svoSMPParallel_h
#define svoSMPParallel_h

#include "svoParallel.h"
#include "vtkSVOCoreModule.h"

namespace svo
{
/// vtkSMPTools with a backend that has threads. Where VTK's backend is Sequential only by default
/// (nobody asked for it by VTK_SMP_BACKEND_IN_USE), STDThread is used inside a
/// vtkSMPTools::LocalScope; VTK's global settings are what they were when the call returns. A limit
/// set by vtkSMPTools::Initialize is respected. May be called from any thread.
VTKSVOCORE_EXPORT ParallelFor smpParallelFor();
}

#endif
