// VTK's lights as the rays have them.
#ifndef svoShadowLights_h
#define svoShadowLights_h

#include "svoShadowShares.h"

#include <string>

class vtkLight;

namespace svo
{
/// Off, with a reason in `problem`, where the light has no place in the world: it "moves with a
/// camera ...". A light that is switched off has no problem.
WeightedLight shadowLight(vtkLight* source, double weight, std::string& problem);
}

#endif
