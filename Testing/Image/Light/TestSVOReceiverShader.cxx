// The shadow test in GLSL says what the processor's says, of random texels and random points: by
// the text and the uniforms that receivers get, a fragment a case. With one of the numbers of
// svoShadowRules.h changed in that text alone it does not.
#include "svoFragments.h"
#include "svoShadowCases.h"
#include "svoTestPicture.h"

#include "svoMapCode.h"
#include "svoShadowReceivers.h"

#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderWindow.h"
#include "vtkShaderProgram.h"

#include <array>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using namespace svotest;

/// By how much shares of light may differ beyond what the processor says of points and planes
/// within rounding (ShadowCases::Rounding, Tilt).
constexpr double Tolerance = 1e-3;
/// The share of cases in which the processor says this here and that there, within rounding.
constexpr double MostUndecided = 0.02;
/// The share of cases that may be wrong all the same, since the processor is asked at a few places
/// only and knows the map exactly. None is on Mesa's llvmpipe.
constexpr double MostWrong = 1e-4;
/// How many times as many have to be wrong where a number differs.
constexpr double Noticed = 10.0;

using OtherNumbers = std::vector<std::array<std::string, 2>>; // names and values

/// The same text with another value of a constant.
std::string withConstant(std::string text, const std::string& name, const std::string& value)
{
  const std::size_t at = text.find(" " + name + " = ") + 1;
  const std::size_t begin = at + name.size() + 3;
  return at == 0 ? std::string() : text.replace(begin, text.find(';', begin) - begin, value);
}

class Shader
{
public:
  Shader(vtkOpenGLRenderWindow* window, const ShadowCases& cases)
    : Window(window)
    , Cases(cases)
    , Inputs(3)
  {
    svo::Light light;
    light.color = glm::vec3(1.0f);
    const std::string complaint =
      this->Maps.update(cases.maps, { light }, cases.eye, cases.settings);
    this->Receivers.update(window, this->Maps.code(), cases.settings.shadowIntensity, false);
    if (!complaint.empty())
    {
      std::cout << complaint << '\n';
    }
    for (const ShadowCase& p : cases.points)
    {
      this->Inputs[0].push_back({ p.position.x, p.position.y, p.position.z, p.extent });
      this->Inputs[1].push_back({ p.facet.x, p.facet.y, p.facet.z, 0.0f });
      this->Inputs[2].push_back({ p.normal.x, p.normal.y, p.normal.z, 0.0f });
    }
  }
  ~Shader()
  {
    this->Receivers.release();
    this->Maps.release();
  }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;

  std::string declarations() const { return this->Receivers.declarations(); }

  /// The share of light that each point misses.
  std::vector<FourFloats> run(const std::string& declarations)
  {
    this->Receivers.activate();
    const std::vector<FourFloats> lit =
      runFragments(this->Window, ShadowCases::Across, this->Inputs, declarations,
        "  vec4 position = texelFetch(input0, at, 0);\n"
        "  gl_FragData[0] = vec4(1.0 - svoShown(svoLeft(0, position.xyz,\n"
        "    texelFetch(input1, at, 0).xyz, texelFetch(input2, at, 0).xyz, vec3(0.0), "
        "position.w)));\n"
        "  gl_FragData[0].a = 1.0;\n", // blending writes it all
        [this](vtkShaderProgram* program) { this->Receivers.setUniforms(program, true, false); });
    this->Receivers.deactivate();
    return lit;
  }

private:
  vtkOpenGLRenderWindow* Window;
  const ShadowCases& Cases;
  svo::MapCode Maps;
  svo::ShadowReceivers Receivers;
  std::vector<std::vector<FourFloats>> Inputs;
};

struct Tally
{
  std::size_t asked = 0, dark = 0, partly = 0, undecided = 0, wrong = 0;
};

Tally compare(const ShadowCases& cases, const std::vector<ShadowCases::Range>& expected,
  const std::vector<FourFloats>& found)
{
  Tally tally;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    if (cases.turnsAway(cases.points[i]))
    {
      continue;
    }
    const ShadowCases::Range& range = expected[i];
    const double dark = found[i][0];
    ++tally.asked;
    tally.dark += range.least > 0.5;
    tally.partly += range.least > 0.01 && range.most < 0.99;
    tally.undecided += range.most - range.least > Tolerance;
    tally.wrong += !(dark >= range.least - Tolerance && dark <= range.most + Tolerance);
  }
  return tally;
}

/// `others`: constants, each with a value that must be noticed.
void compare(vtkOpenGLRenderWindow* window, const std::string& name, const ShadowCases& cases,
  const OtherNumbers& others, Checks& checks)
{
  std::vector<ShadowCases::Range> expected;
  for (const ShadowCase& point : cases.points)
  {
    expected.push_back(cases.darkness(point));
  }
  Shader shader(window, cases);
  const std::vector<FourFloats> found = shader.run(shader.declarations());
  checks.expect(found.size() == cases.points.size(), name + ": the shader runs");
  const Tally tally = compare(cases, expected, found);
  std::cout << name << ": " << tally.asked << " cases, " << tally.dark << " dark, " << tally.partly
            << " partly, " << tally.undecided << " undecided, " << tally.wrong << " wrong\n";
  checks.expect(tally.asked > found.size() / 3, name + ": most facets face the light");
  checks.expect(tally.dark > tally.asked / 20 && tally.dark < tally.asked - tally.asked / 20,
    name + ": some points are dark, some are not");
  checks.expect(
    tally.undecided <= MostUndecided * tally.asked, name + ": rounding decides few cases");
  checks.expect(tally.wrong <= MostWrong * tally.asked, name + ": the shader agrees");
  for (const auto& other : others)
  {
    const std::string text = withConstant(shader.declarations(), other[0], other[1]);
    checks.expect(!text.empty(), name + ": the shader is told " + other[0]);
    const Tally wrong = compare(cases, expected, shader.run(text));
    std::cout << "  with " << other[0] << " = " << other[1] << ": " << wrong.wrong << " wrong\n";
    checks.expect(wrong.wrong > Noticed * MostWrong * wrong.asked,
      name + ": another " + other[0] + " is noticed");
  }
}
}

int TestSVOReceiverShader(int, char*[])
{
  Checks checks;
  vtkNew<vtkRenderWindow> owner;
  owner->SetMultiSamples(0);
  owner->SetSize(ShadowCases::Across, ShadowCases::Across);
  owner->Render();
  vtkOpenGLRenderWindow* window = vtkOpenGLRenderWindow::SafeDownCast(owner);
  unsigned int seed = 0;
  for (const bool parallel : { true, false })
  {
    const std::string light = parallel ? "sun" : "bulb";
    svo::FrameSettings settings;
    // Facets that light of a bulb grazes turn away from some of its rays.
    OtherNumbers plain, border, filtered;
    if (parallel)
    {
      plain = { { "svoNearbyReach", "6.0" }, { "svoGrazingReach", "48.0" },
        { "svoEdgeOnSine", "0.002" }, { "svoLeastSteepness", "0.15" }, { "svoTexelBend", "0.75" },
        { "svoTexelsToAgree", "1" } };
      border = { { "svoMapBorder", "1.01" } };
      filtered = { { "svoNearbyReach", "6.0" }, { "svoTexelBend", "0.55" },
        { "svoWidestBox", "3.8" } };
    }
    const auto run = [&](const std::string& name, bool nested, const OtherNumbers& others)
    {
      compare(window, light + ", " + name, ShadowCases(parallel, nested, settings, ++seed), others,
        checks);
    };
    run("planes", false, plain);
    run("planes, two maps", true, border);
    settings.bias = 0.7;
    run("planes and a bias", false, {});
    settings.automaticBias = false;
    run("a bias", true, {});
    settings.bias = 0.0;
    settings.automaticBias = true;
    settings.filterShadows = true;
    run("filtered", false, filtered);
    run("filtered, two maps", true, {});
  }
  return checks.exitCode();
}
