// A sky of two colours (svoSkyGradient.h), in view coordinates.
//
// The constants svoLampCount, numbers of lights, and svoSky, the sky's first one, come before it.
uniform vec4 svoSkyColors[2]; // the mean; how it rises upwards
uniform vec4 svoSkyUp;

vec3 svoSkyFrom(vec3 way)
{
  return svoSkyColors[0].rgb + dot(way, svoSkyUp.xyz) * svoSkyColors[1].rgb;
}

// What arrives on an open plane.
vec3 svoSkyOver(vec3 normal)
{
  return svoSkyColors[0].rgb + 2.0 / 3.0 * dot(normal, svoSkyUp.xyz) * svoSkyColors[1].rgb;
}

vec3 svoBrightestSky()
{
  return max(svoSkyColors[0].rgb + abs(svoSkyColors[1].rgb), vec3(1e-30));
}

// By number, what is left of what is all around if nothing closes it off.
float svoOpen(int number, vec3 normal)
{
  vec3 seen = svoSkyOver(normal) / svoBrightestSky();
  return svoSky >= 0 && number >= svoSky ? seen[number - svoSky] : 1.0;
}
