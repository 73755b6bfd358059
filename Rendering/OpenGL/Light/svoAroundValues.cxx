#include "svoAroundValues.h"

#include "svoSky.h"

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
    const Sky sky(settings);
    const glm::mat3 turned(view.worldToView);
    if (const SkyPicture* picture = sky.picture())
    {
      ShaderValues::Floats axes{ "svoSkyAxes", 4, {} }, irradiance{ "svoSkyIrradiance", 4, {} };
      for (int i = 0; i < 3; ++i)
      {
        const glm::vec3 axis = turned * picture->axes()[i];
        axes.values.insert(axes.values.end(), { axis.x, axis.y, axis.z, 0.0f });
      }
      for (int k = 0; k < 9; ++k)
      {
        const glm::vec3 part = sky.strength() * picture->irradiance()[k];
        irradiance.values.insert(irradiance.values.end(), { part.r, part.g, part.b, 0.0f });
      }
      values.floats.insert(
        values.floats.end(), { axes, irradiance, { "svoSkyBrightest", 1, { sky.brightest().r } } });
      return;
    }
    const glm::vec3 up = turned * sky.up(), mean = sky.mean(), rise = sky.rise();
    values.floats.push_back(
      { "svoSkyColors", 4, { mean.r, mean.g, mean.b, 0, rise.r, rise.g, rise.b, 0 } });
    values.floats.push_back({ "svoSkyUp", 4, { up.x, up.y, up.z, 0.0f } });
  }
}

std::string sampleConstants(
  const LightCode& code, const std::vector<int>& sums, const FrameSettings& settings)
{
  std::ostringstream text;
  text << (settings.skyLight && settings.skyPicture ? "#define svoHasSkyPicture\n" : "")
       << "const int svoLampCount = " << code.lights.size() << ";\n"
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
