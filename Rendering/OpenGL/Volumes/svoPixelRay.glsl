// The rays of a picture's pixels, view coordinates: at pixel 0, 0, and more at each to the right and up,
// where they begin, less the eye, and their ways, of depth 1.
uniform vec3 svoPixelRays[6];

vec3 svoRayBegins(vec2 pixel)
{
  return svoPixelRays[0] + pixel.x * svoPixelRays[1] + pixel.y * svoPixelRays[2];
}

vec3 svoRayWay(vec2 pixel)
{
  return svoPixelRays[3] + pixel.x * svoPixelRays[4] + pixel.y * svoPixelRays[5];
}
