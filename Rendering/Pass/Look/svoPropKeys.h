// The answers that props and lights carry themselves; vtkSVORenderPass has them as static methods.
#ifndef svoPropKeys_h
#define svoPropKeys_h

class vtkInformationDoubleKey;
class vtkInformationIntegerKey;
class vtkProp;

namespace svo
{
vtkInformationIntegerKey* castShadowKey(); // of lights as well
vtkInformationIntegerKey* receiveShadowKey();
vtkInformationIntegerKey* useSVOKey();
vtkInformationDoubleKey* pixelErrorKey();

/// What a prop says, or else the assembly that owns it; `otherwise` if neither says anything or
/// both are null.
bool flagOf(vtkProp* prop, vtkProp* owner, vtkInformationIntegerKey* key, bool otherwise);
/// Pixels; negative without an answer.
double pixelErrorOf(vtkProp* prop, vtkProp* owner);

/// Nothing happens to a prop that is null.
void setFlag(vtkProp* prop, vtkInformationIntegerKey* key, bool value);
void setPixelError(vtkProp* prop, double error);
}

#endif
