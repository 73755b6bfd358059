// What vtkSVORenderPass tells its users, for programmers, in the order of its TextType.
#ifndef svoPassTexts_h
#define svoPassTexts_h

namespace svo
{
constexpr const char* PassTexts[] = {
  "headlight",
  "No shadows: the only light is a headlight, which casts none that can be seen. "
  "Add a vtkLight with SetLightTypeToSceneLight().",
  "A surface, or some cells of it, cast no shadow because colours or texture make them "
  "translucent. SetCastShadow(true, prop) has all of it cast, false none and in "
  "silence.",
  "A surface casts no shadow because its opacity makes it translucent. "
  "SetTranslucentShadows(true) has it cast one as light as it is, SetCastShadow(true, "
  "prop) a whole one; SetCastShadow(false, prop) makes it cast none in silence.",
  "A surface casts the shadow of its whole cells although its texture hides parts of "
  "them. SetCastShadow(true, prop) says that this is meant, false takes the shadow "
  "away.",
  "was not chosen with SetUseSVO",
  "No shadows: nothing casts any, and GetReason(prop) says why. ",
  "No shadows: there is nothing for them to fall on. ",
  "A surface casts no shadow because its mapper has clipping planes. Data that is "
  "clipped before its mapper (vtkClipPolyData) casts; SetCastShadow(true, prop) has the "
  "surface cast its whole shadow, SetCastShadow(false, prop) none in silence.",
  "",
};
}

#endif
