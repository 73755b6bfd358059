// The sky (svoSky.h), in view coordinates.
//
// The constants svoLampCount, numbers of lights, and svoSky, the sky's first one, come before it.
#ifdef svoHasSkyPicture
uniform vec4 svoSkyAxes[3];       // svoSkyPicture.h; in view coordinates
uniform vec4 svoSkyIrradiance[9]; // times the strength
uniform float svoSkyBrightest;

// What arrives on an open plane.
vec3 svoSkyOver(vec3 normal)
{
  vec3 n = vec3(dot(normal, svoSkyAxes[0].xyz), dot(normal, svoSkyAxes[1].xyz), dot(normal, svoSkyAxes[2].xyz));
  vec3 sum = svoSkyIrradiance[0].rgb + n.x * svoSkyIrradiance[1].rgb + n.y * svoSkyIrradiance[2].rgb +
    n.z * svoSkyIrradiance[3].rgb + n.x * n.y * svoSkyIrradiance[4].rgb + n.y * n.z * svoSkyIrradiance[5].rgb +
    (3.0 * n.z * n.z - 1.0) * svoSkyIrradiance[6].rgb + n.x * n.z * svoSkyIrradiance[7].rgb +
    (n.x * n.x - n.y * n.y) * svoSkyIrradiance[8].rgb;
  return max(sum, vec3(0.0));
}

// No sample counts for more.
vec3 svoBrightestSky()
{
  return max(vec3(svoSkyBrightest), vec3(1e-30));
}
#else
uniform vec4 svoSkyColors[2]; // the mean; how it rises upwards
uniform vec4 svoSkyUp;

vec3 svoSkyFrom(vec3 way)
{
  return svoSkyColors[0].rgb + dot(way, svoSkyUp.xyz) * svoSkyColors[1].rgb;
}

vec3 svoSkyOver(vec3 normal)
{
  return svoSkyColors[0].rgb + 2.0 / 3.0 * dot(normal, svoSkyUp.xyz) * svoSkyColors[1].rgb;
}

vec3 svoBrightestSky()
{
  return max(svoSkyColors[0].rgb + abs(svoSkyColors[1].rgb), vec3(1e-30));
}
#endif

// By number, what is left of what is all around if nothing closes it off.
float svoOpen(int number, vec3 normal)
{
  vec3 seen = svoSkyOver(normal) / svoBrightestSky();
  return svoSky >= 0 && number >= svoSky ? seen[number - svoSky] : 1.0;
}
