#include "svoAroundValues.h"

#include "svoSkyGradient.h"

#include <cstddef>
#include <sstream>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace svo
{
void addAroundValues(const FrameSettings& settings, const View& view, ShaderValues& values)
{
  if (settings.ambientOcclusion)
  {
    values.floats.push_back({ "svoOcclusion", 1,
      { static_cast<float>(settings.ambientOcclusionStrength),
        settings.ambientOcclusionOfAllLight ? 1.0f : 0.0f } });
  }
  if (settings.skyLight)
  {
    const SkyGradient sky(settings);
    const glm::vec3 up = glm::mat3(view.worldToView) * sky.up(), mean = sky.mean(),
                    rise = sky.rise();
    values.floats.push_back(
      { "svoSkyColors", 4, { mean.r, mean.g, mean.b, 0, rise.r, rise.g, rise.b, 0 } });
    values.floats.push_back({ "svoSkyUp", 4, { up.x, up.y, up.z, 0.0f } });
  }
}

std::string sampleConstants(const LightCode& code, const std::vector<int>& sums)
{
  std::ostringstream text;
  text << "const int svoLampCount = " << code.lights.size() << ";\n"
       << "const int svoSky = " << code.sky << ";\n"
       << "const int svoSumOf[] = int[](";
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    text << (i > 0 ? ", " : "") << sums[i];
  }
  text << ");\n";
  return text.str();
}
}
