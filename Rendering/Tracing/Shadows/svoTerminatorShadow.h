// Points at the terminator, asked for by a shadow buffer where that will do, and by rays.
#ifndef svoTerminatorShadow_h
#define svoTerminatorShadow_h

#include "svoLightShadow.h"
#include "svoShadowBuffer.h"
#include "svoShadowRays.h"

#include <vector>

namespace svo
{
/// See LightShadow::testTerminator(). `buffer`: null where all is asked by rays. `rays` may be null
/// where all points are Hidden. `error`: that of the points; `extents`: null where the buffer does
/// not filter.
void testTerminatorPoints(const ShadowBuffer* buffer, const ShadowRays* rays, const Light& light,
  const ShadowQuery& query, double error, const double* extents,
  const std::vector<TerminatorPoint>& points, float* missed);
}

#endif
