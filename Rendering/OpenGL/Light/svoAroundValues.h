// What shaders are told of what is all around surfaces: of ambient occlusion and of a sky.
#ifndef svoAroundValues_h
#define svoAroundValues_h

#include "svoFrame.h"
#include "svoLightCode.h"
#include "svoView.h"

#include <string>
#include <vector>

namespace svo
{
/// Adds the uniforms of svoAmbientCode.h and svoSkyShader.glsl.
void addAroundValues(const FrameSettings& settings, const View& view, ShaderValues& values);

/// The constants of svoSkyShader.glsl and svoSampleMeans.glsl, for code whose lights and numbers
/// are set; `sums`: svoSumOf by number.
std::string sampleConstants(
  const LightCode& code, const std::vector<int>& sums, const FrameSettings& settings);
}

#endif
