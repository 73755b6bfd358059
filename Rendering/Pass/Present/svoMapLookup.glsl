// The share of a light that reaches a fragment of a rasterised surface (svoLightCode.h), by the test of
// svoShadowTest.h, filtered as in svoShadowFilter.cxx. A map holds the linear depth of the
// nearest caster, in tiles of 8x8 texels behind one texture unit, however many lights there are. A
// table of all its tiles, svoTables, says where each one lies; those in which nothing does share one.
// With svoLayered a map is a layer of a texture instead, svoTables[map], or below 0 nothing lies in it.
// Its matrix takes view coordinates to (x, y, linear depth, w), with x / w and y / w in -1..1 across the
// map. `facet` is the fragment's own plane, towards the viewer, `normal` what it is shaded with,
// `extent` how wide a piece of the surface it shows.
//
// Constants are put before it: svoCapacity, maps that there is room for; svoGroups, numbers that
// svoLeft() knows; svoPlaneBias, to compare
// at the texel's own ray, on the planes of the receiver; svoFilter, to weigh the texels around the
// point, with svoPlaneBias only; svoTranslucent, if some maps, from svoFirstTranslucent on, are of
// translucent casters: behind each tile lies how opaque these are. They
// are not asked while it runs, since software OpenGL walks
// through branches that are not taken. And the numbers of svoShadowRules.h, by the same names:
// svoNearbyReach, svoGrazingReach, svoEdgeOnSine, svoLeastSteepness, svoTexelBend, svoTexelsToAgree,
// svoWidestBox, svoMapBorder.
//
// One rule is another one than svoShadowTest.h has: a facet that turns its back on the light lies in
// the shadow of all that is before it, half a texel aside, and is not tested as a plane.
#ifdef svoLayered
uniform sampler2DArray svoMaps; // depth, opacity
#else
uniform samplerBuffer svoMaps;
#endif
uniform int svoTables[svoCapacity];
uniform int svoSize; // texels along an edge of a map
uniform mat4 svoRows[svoCapacity]; // the rows of a map's matrix
uniform float svoErrors[svoCapacity]; // of what casts, world units
uniform float svoManualBias; // world units, added
uniform int svoFirstTranslucent; // map
uniform int svoFirst[svoGroups + 1]; // map of each number; then the number of all maps

// The shorter and the longer edge of a texel in the world, at the depth of a point whose w is given.
vec2 svoTexelEdges(mat4 rows, float w, float size)
{
  vec3 axis = rows[2].xyz;
  float across = length(rows[0].xyz - dot(rows[0].xyz, axis) * axis);
  float up = length(rows[1].xyz - dot(rows[1].xyz, axis) * axis);
  return 2.0 * w / (size * vec2(max(across, up), min(across, up)));
}

#ifdef svoLayered
vec2 svoTexel(int map, ivec2 texel)
{
  int layer = svoTables[map];
  return layer < 0 ? vec2(3e38, 0.0) : texelFetch(svoMaps, ivec3(texel, layer), 0).rg;
}
#else
// Where a texel lies.
int svoTexel(int map, ivec2 texel)
{
  int tile = (texel.y >> 3) * ((svoSize + 7) >> 3) + (texel.x >> 3);
  int begin = 64 * int(texelFetch(svoMaps, svoTables[map] + tile).r);
  return begin + 8 * (texel.y & 7) + (texel.x & 7);
}
#endif

// Depth of the nearest caster, infinite or 3e38 if there is none.
float svoOccluder(int map, ivec2 texel)
{
#ifdef svoLayered
  return svoTexel(map, texel).x;
#else
  return texelFetch(svoMaps, svoTexel(map, texel)).r;
#endif
}

// The share of the light that what lies at a texel takes; 0 if nothing does.
float svoOpacity(int map, ivec2 texel)
{
  if (!svoTranslucent || map < svoFirstTranslucent)
  {
    return 1.0;
  }
#ifdef svoLayered
  return svoTexel(map, texel).y;
#else
  return texelFetch(svoMaps, svoTexel(map, texel) + 64).r;
#endif
}

// What one texel says of the point: 0 lit, 1 dark by an occluder within a few texels' depth, 2 dark.
// `span`: the size of the texel is taken for so many times what it is.
int svoAsk(int map, mat4 rows, float error, vec4 point, vec2 texel, vec3 facet,
  vec3 normal, float span)
{
  float size = float(svoSize);
  if (any(lessThan(texel, vec2(0.0))) || any(greaterThanEqual(texel, vec2(size))))
  {
    return 0;
  }
  float occluder = svoOccluder(map, ivec2(texel)) + svoManualBias;
  float w = dot(rows[3], point);
  float depth = dot(rows[2], point);
  if (!svoPlaneBias)
  {
    return occluder < depth ? 2 : 0;
  }
  vec3 axis = rows[2].xyz;
  vec2 edges = span * svoTexelEdges(rows, w, size);
  float pixel = edges.x;
  float most = svoNearbyReach * pixel; // how far the tangent planes are followed along the ray
  if (!(occluder < depth + most))
  {
    return 0;
  }
  int dark = occluder - svoManualBias < depth - most ? 2 : 1;

  // The ray through the texel's centre is where two planes meet.
  vec2 centre = (texel + 0.5) / size * 2.0 - 1.0;
  vec3 x = rows[0].xyz - centre.x * rows[3].xyz;
  vec3 y = rows[1].xyz - centre.y * rows[3].xyz;
  vec3 xy = cross(x, y);
  vec3 direction = xy / dot(axis, xy); // linear depth grows by 1
  if (dot(facet, direction) > 0.0)
  {
    return occluder < depth + svoTexelBend * pixel ? dark : 0;
  }
  vec2 off = w * centre - vec2(dot(rows[0], point), dot(rows[1], point));
  float receiver = depth + most;
  float steepest = svoLeastSteepness;
  for (int k = 0; k < 2; ++k)
  {
    vec3 n = k == 0 ? facet : normal;
    float slope = abs(dot(n, direction)) / length(direction);
    // Inside a texel a plane in grazing light reaches far towards the light.
    float low = depth - max(most, edges.y / max(slope, 1.0 / svoGrazingReach));
    float plane = low;
    if (slope > svoEdgeOnSine)
    {
      // The step on the plane to the ray.
      vec3 step = (off.x * cross(y, n) + off.y * cross(n, x)) / dot(xy, n);
      plane = clamp(depth + dot(axis, step), low, depth + most);
    }
    receiver = min(receiver, plane);
    steepest = max(steepest, slope);
  }
  return occluder + (svoTexelBend * pixel + error) / steepest < receiver ? dark : 0;
}

// Of a box around 0, its edges blurred by a texel, what lies below x.
float svoCovered(float x, float width)
{
  float beyond = max(0.5 * (width + 1.0) - abs(x), 0.0);
  float part = abs(x) <= 0.5 * (width - 1.0) ? abs(x) / width : 0.5 - 0.5 * beyond * beyond / width;
  return x < 0.0 ? 0.5 - part : 0.5 + part;
}

// True if texels first..last hold nothing, or one surface without steps and creases.
bool svoIsFlat(int map, ivec2 first, ivec2 last, float most)
{
  int hits = 0;
  bool even = true;
  for (int y = first.y; y <= last.y; ++y)
  {
    for (int x = first.x; x <= last.x; ++x)
    {
      float t = svoOccluder(map, ivec2(x, y));
      hits += t < 1e30 ? 1 : 0;
      if (x > first.x + 1)
      {
        float bend = svoOccluder(map, ivec2(x - 2, y)) -
          2.0 * svoOccluder(map, ivec2(x - 1, y)) + t;
        even = even && abs(bend) <= most;
      }
      if (y > first.y + 1)
      {
        float bend = svoOccluder(map, ivec2(x, y - 2)) -
          2.0 * svoOccluder(map, ivec2(x, y - 1)) + t;
        even = even && abs(bend) <= most;
      }
    }
  }
  ivec2 count = last - first + 1;
  return hits == 0 || (even && hits == count.x * count.y);
}

// True if what lies at a texel, followed to the point in the way that the map shows from the texel
// beyond, passes behind the point.
bool svoEndsBefore(
  int map, ivec2 texel, vec2 offset, float depth, float pixel, float error)
{
  int size = svoSize;
  float here = svoOccluder(map, texel);
  float t = here;
  for (int axis = 0; axis < 2; ++axis)
  {
    ivec2 next = texel;
    next[axis] += offset[axis] < 0.0 ? -1 : 1;
    if (next[axis] < 0 || next[axis] >= size)
    {
      return false;
    }
    float farther = svoOccluder(map, next);
    if (!(abs(farther - here) <= svoNearbyReach * pixel))
    {
      return false;
    }
    t -= (farther - here) * abs(offset[axis]);
  }
  return !(t + svoTexelBend * pixel + error < depth);
}

// The share of the light that the point misses. `place`: in texels.
float svoFiltered(int map, mat4 rows, float error, vec4 point, vec2 place,
  ivec2 first, ivec2 last, float width, vec3 facet, vec3 normal)
{
  float size = float(svoSize);
  float depth = dot(rows[2], point);
  float pixel = svoTexelEdges(rows, dot(rows[3], point), size).x;
  float dark = 0.0;
  float all = 0.0;
  for (int y = first.y; y <= last.y; ++y)
  {
    float below = float(y) - place.y;
    float row = svoCovered(below + 1.0, width) - svoCovered(below, width);
    for (int x = first.x; x <= last.x; ++x)
    {
      float left = float(x) - place.x;
      float weight = row * (svoCovered(left + 1.0, width) - svoCovered(left, width));
      vec2 offset = vec2(float(x), float(y)) + 0.5 - place;
      float away = max(abs(offset.x), abs(offset.y));
      int answer = svoAsk(map, rows, error, point, vec2(float(x), float(y)), facet, normal,
        max(1.0, 2.0 * away));
      if (answer == 2 ||
        (answer == 1 &&
          !svoEndsBefore(map, ivec2(x, y), offset, depth, pixel, error)))
      {
        dark += svoTranslucent ? weight * svoOpacity(map, ivec2(x, y)) : weight;
      }
      all += weight;
    }
  }
  return dark / all;
}

// The share that is taken where all that lies in texels first..last is before the point.
float svoTaken(int map, vec2 place, ivec2 first, ivec2 last, float width)
{
  float sum = 0.0;
  float all = 0.0;
  for (int y = first.y; y <= last.y; ++y)
  {
    float below = float(y) - place.y;
    float row = svoCovered(below + 1.0, width) - svoCovered(below, width);
    for (int x = first.x; x <= last.x; ++x)
    {
      float left = float(x) - place.x;
      float weight = svoOccluder(map, ivec2(x, y)) < 1e30
        ? row * (svoCovered(left + 1.0, width) - svoCovered(left, width)) : 0.0;
      sum += weight * svoOpacity(map, ivec2(x, y));
      all += weight;
    }
  }
  return all > 0.0 ? sum / all : 0.0;
}

// What casters leave of a light: the first one of its maps that holds the point is asked.
float svoLeft(int number, vec3 position, vec3 plane, vec3 normal, vec3 lift, float extent)
{
  float size = float(svoSize);
  float lit = 1.0;
  for (int i = svoFirst[number]; i < svoFirst[number + 1]; ++i)
  {
    mat4 rows = svoRows[i];
    float error = svoErrors[i];
    vec4 point = vec4(position, 1.0);
    vec3 facet = plane;
    // Where the facet has turned its back on the light, or nearly so, the smooth surface is asked.
    vec2 centre = vec2(dot(rows[0], point), dot(rows[1], point)) / dot(rows[3], point);
    vec3 xy = cross(rows[0].xyz - centre.x * rows[3].xyz, rows[1].xyz - centre.y * rows[3].xyz);
    vec3 along = xy * sign(dot(rows[2].xyz, xy));
    if (svoPlaneBias && dot(lift, lift) > 0.0 && dot(plane, along) > -length(xy) / svoGrazingReach)
    {
      point.xyz += lift;
      facet = normal;
    }
    float w = dot(rows[3], point);
    if (w <= 0.0)
    {
      continue;
    }
    vec2 at = vec2(dot(rows[0], point), dot(rows[1], point)) / w;
    // Rounding may put a point on the border of two maps beyond both.
    if (any(greaterThan(abs(at), vec2(svoMapBorder))))
    {
      continue;
    }
    vec2 place = clamp((at * 0.5 + 0.5) * size, vec2(0.0), vec2(size));
    vec2 texel = min(floor(place), vec2(size - 1.0));
    float taken = svoOpacity(i, ivec2(texel));
    if (svoFilter && svoPlaneBias)
    {
      float pixel = svoTexelEdges(rows, w, size).x;
      float width = clamp(extent / pixel, 1.0, svoWidestBox);
      ivec2 low = ivec2(max(floor(place - 0.5 * (width + 1.0)), vec2(0.0)));
      ivec2 high = ivec2(min(floor(place + 0.5 * (width + 1.0)), vec2(size - 1.0)));
      if (!svoIsFlat(i, low, high, pixel))
      {
        lit = 1.0 - svoFiltered(i, rows, error, point, place, low, high, width, facet, normal);
        break;
      }
      if (svoTranslucent && i >= svoFirstTranslucent)
      {
        taken = svoTaken(i, place, low, high, width);
      }
    }
    // An occluder nearby has to be one for most of the four texels around the point. The step keeps
    // compilers from unrolling the loop: software OpenGL skips nothing else than turns of a loop.
    vec2 other = vec2(place.x - texel.x < 0.5 ? -1.0 : 1.0, place.y - texel.y < 0.5 ? -1.0 : 1.0);
    int answer = 1;
    int dark = 0;
    for (int k = 0; k < 4; k += answer == 1 ? 1 : 4)
    {
      vec2 neighbour = texel + other * vec2(float(k & 1), float(k >> 1));
      int one = svoAsk(i, rows, error, point, neighbour, facet, normal, 1.0);
      answer = k == 0 ? one : answer;
      dark += k > 0 && one != 0 ? 1 : 0;
    }
    if (answer == 1)
    {
      answer = float(dark) >= svoTexelsToAgree ? 2 : 0;
    }
    lit = answer == 2 ? (svoTranslucent ? 1.0 - taken : 0.0) : 1.0;
    break;
  }
  return lit;
}
