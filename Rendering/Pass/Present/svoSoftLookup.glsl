// The share of a light with a size that reaches a fragment of a rasterised surface: percentage-closer
// soft shadows (R. Fernando, 2005). What hides parts of the light is searched for in its maps; at its
// mean depth rays to the light are looked up. Both lie in spirals by the golden angle, which each
// pixel turns by interleaved gradient noise (J. Jimenez, "Next Generation Post Processing in Call of
// Duty: Advanced Warfare", 2014).
//
// svoMapLookup.glsl comes before it, whose svoLeft() is svoSharpLeft() then.
const int svoSearchSamples = 32;
const int svoFilterSamples = 32;

// By number of svoLeft(): (its middle, 1) or (the unit way to it, 0), view coordinates; (radius of the
// ball or tangent of half the disc's angle, 0: none; how far from there the nearest caster is, or how
// far towards one at infinity from a view's origin).
uniform vec4 svoSources[2 * svoGroups];

float svoNoise(vec2 pixel)
{
  return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}

vec2 svoSpiral(int i, float turn)
{
  float angle = 2.39996323 * float(i) + 6.28318531 * turn;
  return vec2(cos(angle), sin(angle));
}

// What the maps have in the direction of a place: the way to it from a point over whose planes it
// lies, and its opacity; 0 if there is none. `texel`: its longer edge there.
float svoOver(int number, vec3 place, vec3 point, vec3 facet, vec3 normal, out vec3 way, out float texel)
{
  float size = float(svoSize);
  float opacity = 0.0;
  way = vec3(0.0);
  texel = 0.0;
  for (int i = svoFirst[number]; i < svoFirst[number + 1]; ++i)
  {
    mat4 rows = svoRows[i];
    vec4 p = vec4(place, 1.0);
    float w = dot(rows[3], p);
    vec2 at = vec2(dot(rows[0], p), dot(rows[1], p));
    if (w <= 0.0 || any(greaterThan(abs(at), vec2(svoMapBorder * w))))
    {
      continue;
    }
    texel = svoTexelEdges(rows, w, size).y;
    ivec2 index = ivec2(clamp((at / w * 0.5 + 0.5) * size, vec2(0.0), vec2(size - 1.0)));
    float occluder = svoOccluder(i, index) + svoManualBias;
    if (occluder < 1e30)
    {
      // The ray through the texel's centre is where two planes meet.
      vec2 centre = (vec2(index) + 0.5) / size * 2.0 - 1.0;
      vec3 axis = rows[2].xyz;
      vec3 x = rows[0].xyz - centre.x * rows[3].xyz;
      vec3 y = rows[1].xyz - centre.y * rows[3].xyz;
      vec3 xy = cross(x, y) / dot(axis, cross(x, y));
      vec2 off = w * centre - at;
      vec3 aside = (off.x * cross(y, axis) + off.y * cross(axis, x)) / dot(axis, cross(x, y));
      way = place + aside + xy * (occluder - dot(rows[2], p)) - point;
      vec2 edges = svoTexelEdges(rows, dot(rows[3], vec4(point + way, 1.0)), size);
      texel = edges.y;
      if (min(dot(facet, way), dot(normal, way)) > svoTexelBend * edges.x + svoErrors[i])
      {
        opacity = svoOpacity(i, index);
      }
    }
    break;
  }
  return opacity;
}

float svoLeft(int number, vec3 position, vec3 plane, vec3 normal, vec3 lift, float extent)
{
  vec4 source = svoSources[2 * number];
  float size = svoSources[2 * number + 1].x;
  if (size <= 0.0)
  {
    return svoSharpLeft(number, position, plane, normal, lift, extent);
  }
  bool ball = source.w > 0.0;
  vec3 towards = source.xyz - source.w * position;
  vec3 facet = plane;
  // Where the facet has turned its back on the light, or nearly so, the smooth surface is asked.
  if (dot(lift, lift) > 0.0 && dot(plane, towards) < length(towards) / svoGrazingReach)
  {
    position += lift;
    towards -= source.w * lift;
    facet = normal;
  }
  // Of the way to the light, or to one at infinity, so much leads past casters.
  float away = length(towards);
  float nearest = svoSources[2 * number + 1].y;
  float end = ball ? 1.0 - max(nearest, size) / away : nearest - dot(source.xyz, position);
  if (end <= 0.0)
  {
    return 1.0;
  }
  float sine = size / away;
  float cap = sine * sine / (1.0 + sqrt(1.0 - sine * sine)); // solid angle grows by it
  float rim = ball ? size / sqrt(1.0 - sine * sine) : size;
  vec3 axis = towards / away;
  vec3 across = normalize(abs(axis.x) < 0.7 ? vec3(0.0, axis.z, -axis.y) : vec3(axis.z, 0.0, -axis.x));
  vec3 up = cross(axis, across);
  float turn = svoNoise(gl_FragCoord.xy);
  float shift = svoNoise(gl_FragCoord.yx + 17.0);
  vec3 way;
  float texel;
  // The nearest samples lie a texel apart, where what is low hides the light.
  svoOver(number, position, position, facet, normal, way, texel);
  float most = ball ? end / (1.0 - end) : end;
  float power = texel > 0.0
    ? clamp(log(most * rim / texel) / log(float(svoSearchSamples)), 1.0, 4.0) : 1.5;
  float depths = 0.0; // parts of the way to the light
  float texels = 0.0;
  float weights = 0.0;
  for (int i = 0; i < svoSearchSamples; ++i)
  {
    float part = (float(i) + shift) / float(svoSearchSamples);
    vec2 disc = pow(part, power) * svoSpiral(i, turn);
    vec3 place = position + end * (towards + rim * (disc.x * across + disc.y * up));
    if (svoOver(number, place, position, facet, normal, way, texel) > 0.0)
    {
      float depth = dot(way, axis) / away;
      if (depth > 0.0 && length(way - depth * towards) <= depth * rim + texel &&
        (!ball || length(way - towards) > size))
      {
        float bend = max(ball ? depth / (1.0 - depth) : depth, texel / rim);
        float weight = pow(part, 2.0 * power - 1.0) / (bend * bend); // of the light, what its texels hide
        depths += weight * depth;
        texels += weight * texel;
        weights += weight;
      }
    }
  }
  if (weights == 0.0)
  {
    return 1.0;
  }
  float depth = depths / weights;
  float least = texels / (weights * depth); // at the light, a texel there
  float dark = 0.0;
  float seen = 0.0;
  for (int i = 0; i < svoFilterSamples; ++i)
  {
    float square = (float(i) + 0.5) / float(svoFilterSamples);
    float fallen = cap * square;
    float beside = ball ? away * sqrt(fallen * (2.0 - fallen)) / (1.0 - fallen) : size * sqrt(square);
    vec2 disc = svoSpiral(i, turn);
    vec3 aside = disc.x * across + disc.y * up;
    if (dot(towards + beside * aside, facet) > 0.0)
    {
      vec3 place = position + depth * (towards + sqrt(beside * beside + least * least * square) * aside);
      float taken = svoOver(number, place, position, facet, normal, way, texel);
      dark += !ball || length(way - towards) > size ? taken : 0.0;
      seen += 1.0;
    }
  }
  return 1.0 - dark / max(seen, 1.0); // of what turns its back on all of the light nothing is lit
}
