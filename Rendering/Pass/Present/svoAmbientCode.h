// Code that adds a sky's light to what VTK's lighting has made, and takes from it what ambient
// occlusion closes off: as svoPixelShader.cxx does.
#ifndef svoAmbientCode_h
#define svoAmbientCode_h

namespace svo
{
/// Before main().
constexpr const char* AmbientDeclarations = R"(
uniform float svoOcclusion[2]; // the share that it takes; 1: of all light
)";

/// After VTK's lighting, with the sky's first number and the normal.
constexpr const char* SkyAfterLighting = R"(
  vec3 svoOpenSky = svoSkyOver(NORMAL);
  vec3 svoSeenSky = mix(svoOpenSky,
    svoBrightestSky() * vec3(svoShare[SKY], svoShare[SKY + 1], svoShare[SKY + 2]), svoReceive);
)";
/// ... as diffuse light; of physically based materials before what their gamma has done.
constexpr const char* SkyOnColors = "  gl_FragData[0].rgb += diffuseColor * svoSeenSky;\n";
constexpr const char* SkyOnAlbedo =
  "  gl_FragData[0].rgb = pow(pow(gl_FragData[0].rgb, vec3(2.2)) +\n"
  "      (1.0 - metallic) * albedo * svoSeenSky, vec3(1.0 / 2.2));\n";
/// Of shadow catchers (svoShadowCatcher.h).
constexpr const char* SkyOnCatcher =
  "  gl_FragData[0].rg += vec2(dot(svoSeenSky, vec3(1.0)), dot(svoOpenSky, vec3(1.0)));\n";
/// Where there is no light VTK shows colours as they are.
constexpr const char* NoLight = "  gl_FragData[0].rgb += diffuseColor;\n";

/// After that, with the number of what is open.
constexpr const char* OcclusionAfterLighting = R"(
  float svoClosed = svoReceive * svoOcclusion[0] * (1.0 - svoShare[OPEN]);
)";
constexpr const char* OcclusionOnColors =
  "  gl_FragData[0].rgb -=\n"
  "    svoClosed * (svoOcclusion[1] > 0.0 ? gl_FragData[0].rgb : ambientColor);\n";
constexpr const char* OcclusionOnCatcher =
  "  gl_FragData[0].r *= 1.0 - svoOcclusion[1] * svoClosed;\n";
constexpr const char* OcclusionOnAlbedo =
  "  gl_FragData[0].rgb *= pow(1.0 - svoOcclusion[1] * svoClosed, 1.0 / 2.2);\n";
}

#endif
