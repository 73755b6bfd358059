#include "svoMapCode.h"

#include "svoMapLookup.h"
#include "svoOpenGL.h"
#include "svoShadowRules.h"

#include <algorithm>
#include <iomanip>
#include <locale>
#include <map>
#include <sstream>
#include <tuple>

#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

namespace svo
{
namespace
{
constexpr std::size_t MapsOfLight = 6; // that there is room for, where most have fewer

/// Maps that a shader has room for beside what VTK tells it of so many lights.
std::size_t mostMaps(std::size_t lights)
{
  constexpr std::size_t OfLight = 28, OfMap = 24, Others = 512; // components, as vectors of four
  GLint components = 0;
  glGetIntegerv(GL_MAX_FRAGMENT_UNIFORM_COMPONENTS, &components);
  const std::size_t taken = OfLight * lights + Others;
  const std::size_t left = std::max<std::size_t>(components, taken) - taken;
  return std::max(left / OfMap, MapsOfLight);
}

/// The maps of a light's opaque casters, or of a group of its translucent ones.
struct MapGroup
{
  bool translucent;
  int light; // index into Scene::lights, and its number in VTK's shaders
  int group; // ShadowMap::group

  /// Those of opaque casters first.
  bool operator<(const MapGroup& o) const
  {
    return std::tie(this->translucent, this->light, this->group) <
      std::tie(o.translucent, o.light, o.group);
  }
};
using MapGroups = std::map<MapGroup, std::vector<const ShadowMap*>>;

double brightness(const Light& light)
{
  return light.color.r + light.color.g + light.color.b;
}

std::size_t numbersOf(const std::vector<const ShadowMap*>& maps)
{
  std::size_t numbers = 0;
  for (const ShadowMap* map : maps)
  {
    numbers += map->texels ? map->texels->tiles.size() + map->texels->numbers.size() : 0;
  }
  return numbers;
}

MapGroups groupsOf(const std::vector<ShadowMap>& maps)
{
  MapGroups groups;
  for (const ShadowMap& map : maps)
  {
    groups[{ map.group > 0, map.light, map.group }].push_back(&map);
  }
  return groups;
}

/// Leaves maps of the faintest lights out, of each light those of translucent casters first, until
/// no more than `most` maps of no more than `mostNumbers` floats are left. True if there were more.
bool keepBrightest(
  MapGroups& groups, const std::vector<Light>& lights, std::size_t most, std::size_t mostNumbers)
{
  std::size_t count = 0, numbers = 0;
  for (const auto& entry : groups)
  {
    count += entry.second.size();
    numbers += numbersOf(entry.second);
  }
  const std::size_t all = groups.size();
  const auto rank = [&](const MapGroup& group)
  {
    // Of equally bright lights the first one.
    return std::make_tuple(brightness(lights[group.light]), group.light, -group.group);
  };
  while (count > most || numbers > mostNumbers)
  {
    const auto faintest = std::min_element(groups.begin(), groups.end(),
      [&](const auto& a, const auto& b) { return rank(a.first) < rank(b.first); });
    count -= faintest->second.size();
    numbers -= numbersOf(faintest->second);
    groups.erase(faintest);
  }
  return groups.size() < all;
}

/// View coordinates of the eye -> (x, y, linear depth - base, w) of a map. Composed in double, so
/// that world coordinates may be large.
glm::mat4 receiverMatrix(const ShadowMap& map, const View& eye)
{
  const glm::dmat4 toLight = map.view.worldToView * glm::inverse(eye.worldToView);
  glm::dmat4 result = map.view.viewToClip * toLight;
  for (int column = 0; column < 4; ++column)
  {
    result[column][2] = -toLight[column][2];
  }
  result[3][2] -= map.base;
  return glm::mat4(result);
}

/// The constants of svoMapLookup.glsl.
std::string constantsOf(
  const FrameSettings& settings, std::size_t capacity, std::size_t groups, bool translucent)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::boolalpha << "const int svoCapacity = " << capacity << ";\n"
       << "const int svoGroups = " << groups << ";\n"
       << "const bool svoPlaneBias = " << settings.automaticBias << ";\n"
       << "const bool svoFilter = " << settings.filterShadows << ";\n"
       << "const bool svoTranslucent = " << translucent << ";\n"
       << std::showpoint << std::setprecision(9); // a float's; without a point it were an int
  for (const ShadowRule& rule : ShadowRules)
  {
    text << "const float svo" << rule.name << " = " << rule.value << ";\n";
  }
  return text.str();
}
}

std::string MapCode::update(const std::vector<ShadowMap>& maps, const std::vector<Light>& lights,
  const View& eye, const FrameSettings& settings, unsigned int texture)
{
  if (maps.empty())
  {
    this->release();
    return {};
  }
  double casterVoxel = 0.0;
  for (const ShadowMap& map : maps)
  {
    casterVoxel = std::max(casterVoxel, map.casterVoxel);
  }
  MapGroups groups = groupsOf(maps);
  std::string complaint;
  const std::size_t most = mostMaps(lights.size());
  if (keepBrightest(groups, lights, most, MapTextures::most()))
  {
    complaint = "Rasterised surfaces receive shadows of the brightest lights only: OpenGL takes no "
                "more shadow maps.";
  }

  std::vector<const ShadowMap*> kept;
  std::vector<int> first; // map of each group, opaque casters' first; then the number of all
  std::vector<float> rows, errors;
  int firstTranslucent = 0; // map; the number of all maps if there is none
  this->Code.lights.clear();
  for (const auto& [group, ofGroup] : groups)
  {
    if (!group.translucent)
    {
      firstTranslucent = static_cast<int>(kept.size() + ofGroup.size());
    }
    this->Code.lights.push_back(group.light);
    first.push_back(static_cast<int>(kept.size()));
    for (const ShadowMap* map : ofGroup)
    {
      const glm::mat4 matrix = glm::transpose(receiverMatrix(*map, eye));
      rows.insert(rows.end(), &matrix[0][0], &matrix[0][0] + 16);
      errors.push_back(static_cast<float>(map->worldBias));
      kept.push_back(map);
    }
  }
  first.push_back(static_cast<int>(kept.size()));
  const int size = maps.front().view.width;
  if (!this->Maps.upload(kept, texture))
  {
    this->release();
    return "Rasterised surfaces receive no shadows: OpenGL has no room for " +
      std::to_string(kept.size()) + " shadow maps of " + std::to_string(size) +
      " texels. Lower ShadowBufferResolution.";
  }
  // Shaders are not built anew because a light has other maps than before.
  const std::size_t capacity = std::min(std::max(kept.size(), MapsOfLight * groups.size()), most);
  this->Code.text = svoMapLookup;
  this->Code.constants = (texture != 0 ? "#define svoLayered\n" : "") +
    constantsOf(
      settings, capacity, groups.size(), firstTranslucent < static_cast<int>(kept.size()));
  const GLenum target = texture != 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_BUFFER;
  this->Code.textures = { { "svoMaps", this->Maps.name(), target } };
  this->Code.integers = { { "svoTables", this->Maps.tables() }, { "svoSize", { size } },
    { "svoFirst", first }, { "svoFirstTranslucent", { firstTranslucent } } };
  this->Code.floats = { { "svoRows", 16, rows }, { "svoErrors", 1, errors },
    { "svoManualBias", 1, { static_cast<float>(settings.bias * casterVoxel) } } };
  return complaint;
}

void MapCode::release()
{
  this->Code = {};
  this->Maps.release();
}
}
