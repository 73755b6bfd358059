// Code that has rasterised surfaces show nothing but shadows, black and as dense as they take light
// away. VTK's own lighting adds up, as red, the light that arrives and, as green, what would arrive
// without shadows, both on white.
#ifndef svoShadowCatcher_h
#define svoShadowCatcher_h

namespace svo
{
/// Before main(). Colours of lights go through svoWeigh() before VTK's lighting takes them.
constexpr const char* CatcherDeclarations = R"(
uniform float svoCatch; // 1: of this surface shadows alone are seen
vec3 svoWeigh(vec3 color, float share)
{
  float light = color.r + color.g + color.b;
  return svoCatch > 0.0 ? vec3(light * share, light, 0.0) : color * share;
}
)";

/// Before VTK's lighting, of shaders that know of shadows.
constexpr const char* CatcherBeforeLighting = R"(
  if (svoCatch > 0.0)
  {
    ambientColor = specularColor = vec3(0.0);
    diffuseColor = vec3(1.0);
  }
)";

/// After it. No light, or none on this side: no shadow.
constexpr const char* CatcherAfterLighting = R"(
  if (svoCatch > 0.0)
  {
    vec2 svoSums = gl_FragData[0].rg;
    float svoDark = svoSums.g > 0.0 ? 1.0 - svoSums.r / svoSums.g : 0.0;
    if (!(svoDark > 0.0)) discard;
    gl_FragData[0] = vec4(0.0, 0.0, 0.0, svoDark * gl_FragData[0].a);
  }
)";

/// In other shaders: nothing is seen at all.
constexpr const char* CatcherUnseen = "  if (svoCatch > 0.0) discard;\n";
}

#endif
