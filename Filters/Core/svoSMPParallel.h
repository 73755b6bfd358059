// The engine's executors: on VTK's threads, and for what must not be in anybody's way.
#ifndef svoSMPParallel_h
#define svoSMPParallel_h

#include "svoParallel.h"
#include "vtkSVOCoreModule.h"

namespace svo
{
/// vtkSMPTools where VTK's backend is TBB or OpenMP. Where it is STDThread, or Sequential only by
/// default (nobody asked for it by VTK_SMP_BACKEND_IN_USE), plain threads: as many as
/// vtkSMPTools::Initialize or VTK_SMP_MAX_THREADS say, else one for each processor. VTK's global
/// settings are never touched: other threads may be in the middle of VTK's own loops. May be
/// called from any thread.
VTKSVOCORE_EXPORT ParallelFor smpParallelFor();

/// The same, but plain threads in any case, and one less, so that one processor is left to the
/// thread that the user waits for.
VTKSVOCORE_EXPORT ParallelFor backgroundParallelFor();
}

#endif
