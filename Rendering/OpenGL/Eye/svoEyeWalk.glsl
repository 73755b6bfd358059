// What a line of sight sees of an octree of planes (svoEyeCode.h), by the rules of
// svoSurfacePoint.h and svoVoxelLook.cxx. svoOctreeWalk.glsl and svoSeenBoxes.glsl come before it,
// and the constant svoHasColors: whether some planes have colours.
uniform vec4 svoCentre;           // view coordinates: where lines of sight begin, 1; or their direction, 0
uniform float svoNear;            // depth of the near plane
uniform float svoTurn;            // -1: VTK lights the back
uniform usamplerBuffer svoColors; // red, green, blue, alpha in a word, of each plane

// Of the box whose line of sight is followed.
int svoRoot;
int svoDepths;
int svoFirstColor;
float svoDepthOffset;
float svoSeenError; // svoAbove of rays to lights

struct svoSeen
{
  vec3 position;
  vec3 facet;
  vec3 normal;
  vec3 color;
};

float svoDepthOf(vec3 position)
{
  vec4 clip = svoViewToClip * vec4(position, 1.0);
  return 0.5 * clip.z / clip.w + 0.5 + svoDepthOffset;
}

vec3 svoColorOf(uint plane)
{
  uint color = texelFetch(svoColors, svoFirstColor + int(plane)).r;
  return vec3(color & 255u, (color >> 8) & 255u, (color >> 16) & 255u) / 255.0;
}

// The word of svoLists that is the plane of a voxel, or svoNone.
uint svoPlaneAt(ivec3 voxel)
{
  uint child = uint(svoRoot);
  for (int shift = 2 * svoDepths - 2; shift >= 0; shift -= 2)
  {
    uvec4 record = texelFetch(svoNodes, int(child));
    int number = svoNumberOf((voxel >> shift) & 3);
    if (((number < 32 ? record.x : record.y) & (1u << uint(number & 31))) == 0u)
    {
      return svoNone;
    }
    child = svoChildOf(record, number);
  }
  return child;
}

// Normal and colour between the middles of voxels (voxelsAround()); octree coordinates.
void svoBlend(vec3 at, vec3 own, bool colored, inout vec3 normal, inout vec3 color)
{
  int bits = 2 * svoDepths;
  vec3 place = (at - 1.0) * float(1 << bits) - 0.5;
  vec3 corner = floor(place);
  vec3 upper = place - corner;
  vec3 normals = vec3(0.0);
  vec3 colors = vec3(0.0);
  float weights = 0.0;
  for (int i = 0; i < 8; ++i)
  {
    ivec3 step = ivec3(i & 1, (i >> 1) & 1, i >> 2);
    ivec3 voxel = ivec3(corner) + step;
    uint number = all(equal(voxel >> bits, ivec3(0))) ? svoPlaneAt(voxel) : svoNone;
    if (number == svoNone)
    {
      continue;
    }
    vec3 one = svoNormalOf(texelFetch(svoLists, int(number)).r);
    if (dot(one, own) > 0.5)
    {
      vec3 shares = mix(1.0 - upper, upper, vec3(step));
      float share = shares.x * shares.y * shares.z;
      normals += share * one;
      if (colored)
      {
        colors += share * svoColorOf(number);
      }
      weights += share;
    }
  }
  normal = dot(normals, normals) > 1e-12 ? normals : own;
  color = colored && weights > 1e-6 ? colors / weights : color;
}

// The normal of the face of a cube that a point is on, of those that face the viewer (faceOfVoxel()).
vec3 svoFaceAt(vec3 at, vec3 way)
{
  vec3 place = (at - 1.0) * float(1 << (2 * svoDepths));
  vec3 beside = abs(place - round(place));
  return beside.x <= beside.y && beside.x <= beside.z ? vec3(way.x > 0.0 ? -1.0 : 1.0, 0.0, 0.0)
    : beside.y <= beside.z                            ? vec3(0.0, way.y > 0.0 ? -1.0 : 1.0, 0.0)
                                                      : vec3(0.0, 0.0, way.z > 0.0 ? -1.0 : 1.0);
}

bool svoSees(int box, vec3 end, vec3 viewEnd, out svoSeen seen)
{
  vec4 color = svoOfBox(box, 11);
  bool colored = svoHasColors && color.w > 0.0;
  svoFirstColor = svoNumberIn(svoOfBox(box, 12).w, svoOfBox(box, 13).w);
  vec4 x = svoOfBox(box, 3);
  vec4 y = svoOfBox(box, 4);
  vec4 z = svoOfBox(box, 5);
  svoRoot = svoNumberIn(x.w, y.w);
  svoDepths = int(z.w);
  vec3 viewWay = svoCentre.w > 0.0 ? viewEnd - svoCentre.xyz : svoCentre.xyz;
  vec3 way = vec3(dot(x.xyz, viewWay), dot(y.xyz, viewWay), dot(z.xyz, viewWay));
  x = svoOfBox(box, 6);
  y = svoOfBox(box, 7);
  z = svoOfBox(box, 8);
  svoDepthOffset = x.w;
  svoSeenError = y.w;
  mat3 normalToView = transpose(mat3(x.xyz, y.xyz, z.xyz));
  // From the near plane on, or from before the box: `end` is where floats are good.
  float back = min(2.0 / length(way), (svoNear + viewEnd.z) / viewWay.z);
  vec3 from = end + 1.5 - back * way;
  vec4 low = svoOfBox(box, 9);
  svoEnds ends = svoEnds(low.xyz, svoOfBox(box, 10).xyz, low.w, 0.0);
  svoHitAt = 0.0;
  if (!svoMeetsOctree(from, way, 1.001 * back, uint(svoRoot), svoDepths, ends))
  {
    return false;
  }
  bool cubes = ends.reach < 0.0;
  vec3 own = cubes ? svoFaceAt(from + svoHitAt * way, way)
                   : svoNormalOf(texelFetch(svoLists, int(svoHit)).r);
  vec3 towards = -normalize(viewWay);
  vec3 outwards = normalize(normalToView * own);
  float side = dot(outwards, towards) < 0.0 ? -1.0 : 1.0;
  seen.position = viewEnd + (svoHitAt - back) * viewWay;
  seen.facet = side * outwards;
  seen.normal = seen.facet;
  seen.color = colored ? svoColorOf(svoHit) : color.rgb;
  if (z.w <= 0.0 && !cubes)
  {
    vec3 normal = own;
    svoBlend(from + svoHitAt * way, own, colored, normal, seen.color);
    normal = side * normalize(normalToView * normal);
    float away = min(dot(normal, towards), 0.0);
    seen.normal = normalize(normal - away * towards); // on an outline it may turn away
  }
  seen.normal *= svoTurn;
  return true;
}
