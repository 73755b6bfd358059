// Adds samples of what reaches a pixel: of a light with a size, of the sky, or of what is open around
// it. The directions are those of svoSampleDirections.h, distributed as svoSampleSequence.h has it.
//
// svoRayWalk.glsl comes before it, and svoSkyShader.glsl.
uniform sampler2D svoPlaces; // svoShadowMaskShader.glsl
uniform sampler2D svoPlanes;
uniform usamplerBuffer svoSequence; // a mask of blue noise, 64x64; points of the square, two each
uniform int svoNumber; // of svoLeft(), whose samples these are
uniform int svoStream;
uniform float svoSize; // LightCode::Sampled
uniform int svoNoiseShift[2]; // noiseShift()
uniform int svoRowsOfSlice; // ReceiverPlaces::sliceRows
uniform int svoFirstSample;
uniform int svoEndSample;

uint svoNoise(uvec2 pixel)
{
  uvec2 at = pixel & 63u;
  return texelFetch(svoSequence, int(64u * at.y + at.x)).r;
}

vec2 svoDisc(uvec2 square)
{
  vec2 p = 2.0 / 16777216.0 * vec2(square >> 8u) - 1.0;
  bool wide = abs(p.x) > abs(p.y);
  float radius = wide ? p.x : p.y;
  float angle = 0.785398163 * (radius == 0.0 ? 0.0 : (wide ? p.y : p.x) / radius);
  return radius * (wide ? vec2(cos(angle), sin(angle)) : vec2(sin(angle), cos(angle)));
}

// svoSampleDirections.h
mat3 svoBasis(vec3 z)
{
  float side = z.z < -1e-4 ? -1.0 : 1.0;
  float a = -1.0 / (side + z.z);
  float b = z.x * z.y * a;
  return mat3(1.0 + side * z.x * z.x * a, side * b, -side * z.x, b, side + z.y * z.y * a, -z.y, z);
}

#ifdef svoHasSkyPicture
uniform samplerBuffer svoSkyTable; // SkyPicture::table()
uniform int svoSkySize[2];         // columns and rows

// Of sums from `first` on the interval that x lies in, and where in it.
int svoDrawn(int first, int count, inout float x)
{
  int low = 0;
  for (int high = count; high - low > 1;)
  {
    int middle = (low + high) / 2;
    bool after = texelFetch(svoSkyTable, first + middle).r <= x;
    low = after ? middle : low;
    high = after ? high : middle;
  }
  float begin = texelFetch(svoSkyTable, first + low).r;
  float width = texelFetch(svoSkyTable, first + low + 1).r - begin;
  x = width > 0.0 ? min((x - begin) / width, 1.0) : 0.5;
  return low;
}

// A direction, along the picture's axes, and the colour of its cell.
vec3 svoSkySample(uvec2 square, out vec3 color)
{
  const float pi = 3.14159265;
  vec2 at = vec2(square >> 8u) / 16777216.0;
  int columns = svoSkySize[0];
  int rows = svoSkySize[1];
  int row = svoDrawn(0, rows, at.y);
  int column = svoDrawn(rows + 1 + row * (columns + 1), columns, at.x);
  int first = rows + 1 + rows * (columns + 1) + 3 * (row * columns + column);
  for (int c = 0; c < 3; ++c)
  {
    color[c] = texelFetch(svoSkyTable, first + c).r;
  }
  float up = mix(sin(pi * (float(row) / float(rows) - 0.5)), sin(pi * (float(row + 1) / float(rows) - 0.5)), at.y);
  float longitude = 2.0 * pi * ((float(column) + at.x) / float(columns) - 0.5);
  return vec3(sqrt(max(1.0 - up * up, 0.0)) * vec2(cos(longitude), sin(longitude)), up).xzy;
}
#endif

// Sums of red, green and blue, and how many samples count.
vec4 svoAnswerAt(ivec2 pixel)
{
  vec4 sums = vec4(0.0);
  vec4 place = texelFetch(svoPlaces, pixel, 0);
  vec4 planes = 2.0 * texelFetch(svoPlanes, pixel, 0) - 1.0;
  vec3 facet = svoUnfold(planes.xy);
  vec3 normal = svoUnfold(planes.zw);
  bool lamp = svoNumber < svoLampCount;
  vec4 source = svoLights[svoNumber];
  vec3 axis = dot(normal, facet) > 0.0 ? normal : facet;
  vec3 towards = lamp ? source.xyz - source.w * place.xyz : axis;
  if (place.w <= -svoFar || (lamp && dot(normal, towards) <= 0.0))
  {
    return sums; // it is not lit anyway
  }
  if (lamp && place.w > 0.0 && dot(facet, towards) <= svoDoubtfulSine * length(towards))
  {
    place.xyz += place.w * normal; // the smooth surface
    towards -= source.w * place.w * normal;
    facet = normal;
  }
  svoAbove = max(-place.w, 0.0);
  float away = length(towards);
  bool ball = lamp && source.w > 0.0;
  float sine = ball ? min(svoSize / away, 1.0) : 0.0;
  float cap = sine * sine / (1.0 + sqrt(1.0 - sine * sine)); // solid angle grows by it
  mat3 toWorld = mat3(svoViewToTree);
  mat3 basis = svoBasis(toWorld * (towards / away));
  uvec2 at = uvec2(pixel.x + svoNoiseShift[0], pixel.y % svoRowsOfSlice + svoNoiseShift[1]) + uint(svoStream) * uvec2(23u, 13u);
  uvec2 turn = uvec2(svoNoise(at), svoNoise(at + uvec2(37u, 17u)));
  for (int i = svoFirstSample; i < svoEndSample; ++i)
  {
    uvec2 square = uvec2(texelFetch(svoSequence, 4096 + 2 * i).r, texelFetch(svoSequence, 4097 + 2 * i).r);
    vec2 disc = svoDisc(square + turn);
    float radius2 = dot(disc, disc);
    vec3 local = vec3(disc, sqrt(max(0.0, 1.0 - radius2)));
    float end = svoSize;
    if (ball)
    {
      float fallen = cap * radius2;
      local = vec3(sqrt(cap * (2.0 - fallen)) * disc, 1.0 - fallen);
      end = away * (local.z - sqrt(max(0.0, sine * sine - fallen * (2.0 - fallen))));
    }
    else if (lamp)
    {
      local = normalize(vec3(svoSize * disc, 1.0));
      end = svoFar;
    }
    vec3 way = (basis * local) * toWorld; // back to the view
    vec3 seen = vec3(1.0);
    float left = 1.0;
#ifdef svoHasSkyPicture
    if (svoNumber == svoSky)
    {
      local = svoSkySample(square + turn, seen);
      way = local.x * svoSkyAxes[0].xyz + local.y * svoSkyAxes[1].xyz + local.z * svoSkyAxes[2].xyz;
      seen *= max(dot(way, axis), 0.0);
    }
#else
    seen = svoNumber == svoSky ? svoSkyFrom(way) / svoBrightestSky() : seen;
#endif
    bool above = dot(way, facet) > 0.0;
    if (above)
    {
      left = svoLeftAlong(place.xyz, facet, way, end);
    }
#ifdef svoHasSkyPicture
    above = above || svoNumber == svoSky;
#endif
    if (above)
    {
      sums += vec4(floor(4096.0 * left * seen + 0.5) / 4096.0, 1.0);
    }
  }
  return sums;
}
