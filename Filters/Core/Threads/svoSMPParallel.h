// The engine's executors: on VTK's threads, and on plain threads for builds in the background.
#ifndef svoSMPParallel_h
#define svoSMPParallel_h

#include "svoParallel.h"
#include "vtkSVOCoreModule.h"

namespace svo
{
/// vtkSMPTools where VTK's backend is TBB or OpenMP. Where it is STDThread: plain threads, as many
/// as vtkSMPTools::Initialize says. Where it is Sequential only by default (nobody asked for it by
/// VTK_SMP_BACKEND_IN_USE), as in ParaView: plain threads, one for each processor or as many as
/// VTK_SMP_MAX_THREADS says if that is less; what Initialize says that backend does not tell. VTK's
/// global settings are never touched: other threads may be in the midst of VTK's own loops. May be
/// called from any thread.
VTKSVOCORE_EXPORT ParallelFor smpParallelFor();

/// The same, but plain threads in any case, and one less in each loop: a loop in the background
/// leaves a processor to the thread that the user waits for.
VTKSVOCORE_EXPORT ParallelFor backgroundParallelFor();
}

#endif
