// Who makes a frame's picture, and how shadows are found in it.
#ifndef svoFrameChoice_h
#define svoFrameChoice_h

#include "svoFrame.h"

#include <functional>
#include <string>

namespace svo
{
/// What it hangs on, besides the settings of the frame.
struct FrameWishes
{
  bool automatic = false; // OpenGL makes the picture if it is preferred; else `openGL` says so
  bool openGL = false;
  bool sampled = false; // lights with a size, or hemispheres: samples are rays
  bool severalProcesses = false;
  /// Asked once or twice, where that is to decide: whether OpenGL may be taken, and whether it has
  /// rays to lights as fast; for `volumes`, which are its alone, however fast it is.
  std::function<bool(bool rays, bool volumes)> prefersOpenGL;
};

/// Whether OpenGL makes the picture.
struct FrameChoice
{
  bool openGL = false;
  bool hangsOnPlanes = false; // `openGL` is that surfaces without triangles are not seen
};

/// `settings`: as they were asked for; become the tracer's, whose technique is None, Buffer or
/// Rays. `planes`: surfaces without triangles are seen.
inline FrameChoice chooseFrame(FrameSettings& settings, const FrameWishes& wishes, bool planes)
{
  const ShadowTechnique asked = settings.shadowTechnique;
  const bool volumes = asked == ShadowTechnique::Volumes;
  const bool byRays = asked == ShadowTechnique::Rays || volumes || wishes.sampled;
  FrameChoice choice;
  choice.hangsOnPlanes =
    wishes.automatic && wishes.prefersOpenGL(byRays, volumes && !wishes.sampled);
  choice.openGL = choice.hangsOnPlanes ? !planes : !wishes.automatic && wishes.openGL;
  const bool rays = choice.openGL &&
    (byRays ||
      (asked == ShadowTechnique::Automatic &&
        (!wishes.automatic || wishes.prefersOpenGL(true, false))));
  settings.shadowVolumes = choice.openGL && volumes;
  if (volumes)
  {
    settings.shadowTechnique = ShadowTechnique::Rays;
  }
  else if (asked == ShadowTechnique::Automatic || (choice.openGL && asked != ShadowTechnique::None))
  {
    settings.shadowTechnique = rays ? ShadowTechnique::Rays : ShadowTechnique::Buffer;
  }
  const bool maps = settings.shadowTechnique == ShadowTechnique::Buffer;
  // Processes merge the CPU's maps.
  settings.lightCode = choice.openGL && (!maps || !wishes.severalProcesses);
  if (maps && wishes.sampled && wishes.severalProcesses && !choice.openGL)
  {
    settings.shadowTechnique = ShadowTechnique::Rays; // which have all casters on all of them
  }
  return choice;
}

/// What to tell of shadow volumes that were asked for, where the CPU makes the picture.
inline std::string whyNoVolumes(const FrameWishes& wishes)
{
  const char* const remedy = wishes.sampled || wishes.severalProcesses ? ""
    : wishes.automatic ? " SetBackendToOpenGL() has OpenGL draw."
                       : " SetBackendToAuto() has OpenGL draw.";
  return std::string("OpenGL draws shadow volumes, and the CPU makes this picture: exact rays find "
                     "the same shadows.") +
    remedy;
}
}

#endif
