// Information keys of props and lights: casts, receives, shows shadows alone, uses octrees, pixel
// error. The static methods of vtkSVORenderPass set and read them.
#ifndef svoPropKeys_h
#define svoPropKeys_h

#include <utility>

class vtkInformation;
class vtkInformationDoubleKey;
class vtkInformationIntegerKey;
class vtkLight;
class vtkProp;

namespace svo
{
vtkInformationIntegerKey* castShadowKey(); // of lights as well
vtkInformationIntegerKey* receiveShadowKey();
vtkInformationIntegerKey* useSVOKey();
vtkInformationIntegerKey* shadowCatcherKey();
vtkInformationDoubleKey* pixelErrorKey();
vtkInformationDoubleKey* lightSizeKey(); // of lights

/// The key's value of a prop, else of the assembly that owns the prop; `otherwise` if neither has
/// one or both are null.
bool flagOf(vtkProp* prop, vtkProp* owner, vtkInformationIntegerKey* key, bool otherwise);
/// The same of the pixel error, pixels; negative if neither has one.
double pixelErrorOf(vtkProp* prop, vtkProp* owner);

/// All answers that a prop carries, as numbers. (The time of its keys says little: VTK's render
/// passes write to them in every frame.)
using PropAnswers = std::pair<unsigned int, double>;
PropAnswers answersOf(vtkProp* prop);

/// The size that somebody gave a light, here or, where that is 0, for VTK's ray tracing backend,
/// which has it in the same units; 0 if nobody did.
double lightSizeOf(vtkLight* light);

/// Its keys, made if it has none.
vtkInformation* keysOf(vtkProp* prop);
vtkInformation* keysOf(vtkLight* light);

/// A prop that is null is ignored.
void setFlag(vtkProp* prop, vtkInformationIntegerKey* key, bool value);
}

#endif
