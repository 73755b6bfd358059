// The sides of shadow volumes, and their caps: triangles as they are, and as far away as they can be.
// svoCaps is put before it, 0: sides, 1: caps; svoAtVertices in vertex shaders.
//
// svoCasters has four texels a caster: the rows of the matrix that takes coordinates of the octree's
// cube, whose middle is 0 and whose edges are 1, to view coordinates; and (where its senses begin /
// 4096, the rest, how far along the light, from the eye on, its volume reaches, or svoEndless, how far
// its triangles may lie beside what is drawn of them, below 0 if the matrix mirrors). svoEdges: corners from and to, and the caster. svoSenses: LightContour::senses().
#ifdef svoAtVertices
uniform samplerBuffer svoCasters;
uniform samplerBuffer svoTriangles;
uniform vec4 svoLight; // view coordinates: towards it, 0, or its place, 1
uniform mat4 svoProjection;
uniform float svoParallel; // 1: rays of the picture are parallel
uniform int svoFirst;
invariant gl_Position; // of sides and caps, whose programs are two
flat out vec4 svoPlane; // of the triangle, view coordinates, unit; 0: it is far away

vec4 svoCornerAt(int caster, int corner)
{
  vec4 at = vec4(texelFetch(svoTriangles, corner).xyz - 1.5, 1.0);
  return vec4(dot(texelFetch(svoCasters, caster), at), dot(texelFetch(svoCasters, caster + 1), at),
    dot(texelFetch(svoCasters, caster + 2), at), 1.0);
}

const float svoEndless = 1e37;

// Where the ray from the light goes on to: the end of the volume, or infinity, or in pictures of
// parallel rays, which would not meet triangles that lie there, far away.
vec4 svoAway(vec4 at, float end)
{
  if (end < svoEndless)
  {
    vec3 way = -normalize(svoLight.xyz);
    return vec4(at.xyz + (end - dot(way, at.xyz)) * way, 1.0);
  }
  float far = svoParallel * 1e-7;
  vec3 from = svoLight.w > 0.0 ? svoLight.xyz : at.xyz;
  return vec4(far * from + svoLight.w * at.xyz - svoLight.xyz, far);
}

// Nothing is cut at the near or the far plane.
vec4 svoShown(vec4 at)
{
  vec4 clip = svoProjection * at;
  return vec4(clip.xy, 0.0, clip.w);
}

vec3 svoScaled(vec3 way)
{
  return way / max(max(max(abs(way.x), abs(way.y)), abs(way.z)), 1e-37);
}

// Of what is spanned by two ways, of any length; 0 if they have none.
vec4 svoPlaneOf(vec3 u, vec3 v, vec3 at)
{
  vec3 normal = cross(svoScaled(u), svoScaled(v));
  normal /= max(length(normal), 1e-30);
  return vec4(normal, -dot(normal, at));
}

#if svoCaps
uniform usamplerBuffer svoSenses;
uniform int svoFirstTriangle;
uniform int svoCorners; // of a triangle: 3, or with those far away 6

void main()
{
  int face = gl_VertexID / svoCorners;
  int corner = gl_VertexID % svoCorners;
  int caster = svoFirst + 4 * gl_InstanceID;
  vec4 of = texelFetch(svoCasters, caster + 3);
  int first = int(of.x) * 4096 + int(of.y);
  uint sense = texelFetch(svoSenses, first + face / 16).x >> uint(2 * (face % 16)) & 3u;
  int from = 3 * (svoFirstTriangle + face);
  vec4 a = svoCornerAt(caster, from);
  vec4 b = svoCornerAt(caster, from + 1);
  vec4 c = svoCornerAt(caster, from + 2);
  bool turned = (sense == 2u) != (of.w < 0.0);
  turned = turned != (corner >= 3);
  int k = corner % 3;
  vec4 at = k == 0 ? a : (k == 1) != turned ? b : c;
  svoPlane = svoPlaneOf(b.xyz - a.xyz, c.xyz - a.xyz, a.xyz);
  if (corner >= 3 && of.z < svoEndless)
  {
    svoPlane = vec4(-normalize(svoLight.xyz), -of.z);
  }
  else if (corner >= 3)
  {
    vec4 away = svoAway(a, of.z);
    svoPlane = svoParallel > 0.0
      ? svoPlaneOf(svoAway(b, of.z).xyz - away.xyz, svoAway(c, of.z).xyz - away.xyz, away.xyz / away.w)
      : vec4(0.0);
  }
  // Behind what is drawn of it.
  float side = svoParallel > 0.0 ? svoPlane.z : svoPlane.w;
  svoPlane.w += corner < 3 ? (side < 0.0 ? -abs(of.w) : abs(of.w)) : 0.0;
  at = corner < 3 ? at : svoAway(at, of.z);
  // What is left out has no size.
  gl_Position = sense == 0u ? vec4(0.0, 0.0, 0.0, 1.0) : svoShown(at);
}
#else
uniform usamplerBuffer svoEdges;

void main()
{
  uvec4 edge = texelFetch(svoEdges, svoFirst + gl_VertexID / 6);
  const int ends[6] = int[6](1, 0, 2, 1, 2, 3);
  int end = ends[gl_VertexID % 6];
  int caster = int(edge.z);
  vec4 of = texelFetch(svoCasters, caster + 3);
  bool mirrors = of.w < 0.0;
  bool from = (end == 0 || end == 2) != mirrors;
  vec4 a = svoCornerAt(caster, int(edge.x));
  vec4 b = svoCornerAt(caster, int(edge.y));
  svoPlane = svoPlaneOf(b.xyz - a.xyz, svoLight.w * a.xyz - svoLight.xyz, a.xyz);
  vec4 at = from ? a : b;
  gl_Position = svoShown(end < 2 ? at : svoAway(at, of.z));
}
#endif

#else
// Depths are those of planes at pixels' rays: what is interpolated over triangles that reach from behind
// the eye to infinity has no digits.
uniform float svoReach[2]; // VolumeDraws
uniform float svoParallel;
flat in vec4 svoPlane;

void main()
{
  float depth = -(dot(svoPlane.xyz, svoRayBegins(gl_FragCoord.xy)) + svoPlane.w) /
    dot(svoPlane.xyz, svoRayWay(gl_FragCoord.xy));
  // Where a side ends, far away, its plane vanishes: rounded, that is before the eye as often as behind it.
  bool vanishes = svoParallel == 0.0 && depth < -(abs(svoReach[0]) + svoReach[1]);
  gl_FragDepth = svoPlane.xyz == vec3(0.0) || vanishes ? 1.0 : clamp((depth - svoReach[0]) / svoReach[1], 0.0, 1.0);
}
#endif
