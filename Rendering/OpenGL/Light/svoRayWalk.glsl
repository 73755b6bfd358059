// How much of a light reaches a fragment of a rasterised surface (svoLightCode.h), by a ray from there
// through the octrees of all that casts, by the rules of svoShadowRays.cxx and svoTerminator.h.
//
// svoCasters holds a tree of the casters' boxes, two texels a node, in the order in which it is
// walked: (lower corner, node after all that is below), (upper corner, caster or -1). Behind it, from
// svoFirstCaster on, six texels a caster: the rows of the matrix that takes view coordinates to octree
// coordinates; (root / 4096, root % 4096, depths, opacity, or -1 - n: what follows from 8 n on in
// svoAlphas; svoCasterAlphas.h); and of octrees of planes (lower corner of
// what they show, svoEnds::reach), (upper corner, how far planes may lie
// over what VTK draws in their place), octree coordinates and voxels. Boxes are in coordinates of their own, svoViewToTree.
//
// svoOctreeWalk.glsl and svoColorAlpha.glsl come before it, and the constants svoLightCount and svoDoubtfulSine.
uniform samplerBuffer svoCasters;
uniform int svoTreeSize;    // nodes
uniform int svoFirstCaster; // texel
uniform mat4 svoViewToTree;
uniform vec4 svoLights[svoLightCount]; // view coordinates: (towards it, 0), or (its place, 1)

const float svoFar = 1e30;
const float svoBeforeLight = 0.99999; // where rays to a light at 1 end

// What floats resolve of a position that a rasteriser has interpolated, by its size.
const float svoPositionError = 1e-6;
// ... and of a place in an octree, by its distance from the cube's corner.
const float svoOctreeError = 6e-7;

// How far above its own surface, at least, a ray begins: of what was traced the error of its leaves, as
// on the CPU. 0 where VTK has drawn a contour: rays may begin behind the planes.
#define svoRays
float svoAbove = 0.0;

// True where shadow volumes stand for opaque casters of triangles: rays pass these by.
bool svoBesideVolumes = false;

// The share that a caster whose colours have alpha takes of a ray: where that meets it first, seen from
// the light, or from beyond the octree.
float svoTakenByColors(int at, vec3 from, vec3 way, float end, uint root, int depths, svoEnds ends)
{
  float far = min(end, (distance(from, vec3(1.5)) + 1.0) / length(way)); // the cube is 1..2
  svoHit = svoNone;
  svoNearest = true;
  svoMeetsOctree(from + far * way, -way, far, root, depths, ends);
  svoNearest = false;
  return svoHit == svoNone ? -1.0 : svoTakenByHit(at);
}

// What casters leave on the way from `from` along `way`, up to `end` times as far: 0 where an opaque
// one is met. The ray starts beside its surface, along `side`, by what floats resolve.
float svoLeftAlong(vec3 from, vec3 side, vec3 way, float end)
{
  float left = 1.0;
  vec3 start = from + max(svoAbove, svoPositionError * length(from)) * side;
  if (any(isnan(start)))
  {
    return 1.0; // or it walked on and on
  }
  vec3 treeStart = (svoViewToTree * vec4(start, 1.0)).xyz;
  vec3 treeWay = mat3(svoViewToTree) * way;
  vec3 inverse = 1.0 /
    vec3(treeWay.x < 0.0 ? min(treeWay.x, -1e-20) : max(treeWay.x, 1e-20),
      treeWay.y < 0.0 ? min(treeWay.y, -1e-20) : max(treeWay.y, 1e-20),
      treeWay.z < 0.0 ? min(treeWay.z, -1e-20) : max(treeWay.z, 1e-20));
  int node = 0;
  while (left > 0.0)
  {
    // Each ray goes to its next caster before any walks through one: rays run side by side.
    int caster = -1;
    while (node < svoTreeSize && caster < 0)
    {
      vec4 low = texelFetch(svoCasters, 2 * node);
      vec4 high = texelFetch(svoCasters, 2 * node + 1);
      vec3 a = (low.xyz - treeStart) * inverse;
      vec3 b = (high.xyz - treeStart) * inverse;
      vec3 enters = min(a, b);
      vec3 leaves = max(a, b);
      bool met = max(max(max(enters.x, enters.y), enters.z), 0.0) <=
        min(min(min(leaves.x, leaves.y), leaves.z), end);
      caster = met ? int(high.w) : -1;
      node = met ? node + 1 : int(low.w);
    }
    if (caster < 0)
    {
      break;
    }
    int at = svoFirstCaster + 6 * caster;
    vec4 x = texelFetch(svoCasters, at);
    vec4 y = texelFetch(svoCasters, at + 1);
    vec4 z = texelFetch(svoCasters, at + 2);
    vec4 what = texelFetch(svoCasters, at + 3);
    vec4 point = vec4(start, 1.0);
    vec3 local = vec3(dot(x, point), dot(y, point), dot(z, point));
    vec3 localSide = vec3(dot(x.xyz, side), dot(y.xyz, side), dot(z.xyz, side));
    vec3 localWay = vec3(dot(x.xyz, way), dot(y.xyz, way), dot(z.xyz, way));
    vec4 low = svoHasPlanes ? texelFetch(svoCasters, at + 4) : vec4(0.0);
    vec4 high = svoHasPlanes ? texelFetch(svoCasters, at + 5) : vec4(0.0);
    if (svoBesideVolumes && what.w == 1.0 && low.x == 0.0)
    {
      continue;
    }
    localSide = normalize(localSide);
    // (No point of its surface lies beyond the cube, at 2.)
    float corner = max(max(abs(local.x), abs(local.y)), abs(local.z));
    local += svoOctreeError * clamp(corner, 1.0, 2.0) * localSide;
    // A ray may start behind the planes of its own surface. What it meets before it can have left
    // them has to be met from outside of them too (ShadowRays::blocks()).
    float outside = svoAbove > 0.0 ? 0.0 : high.w / float(1 << (2 * int(what.z)));
    svoEnds ends = svoEnds(low.xyz, high.xyz, low.w,
      outside / max(dot(localSide, localWay), 0.05 * length(localWay)));
    uint root = uint(what.x) * 4096u + uint(what.y);
    vec3 near = local;
    bool met = false;
    for (int start = 0; start < (svoHasPlanes ? 2 : 1); ++start)
    {
      svoDoubted = false;
      met = svoMeetsOctree(local, localWay, end, root, int(what.z), ends);
      if (met || !svoDoubted)
      {
        break;
      }
      local += outside * localSide;
      ends.doubtful = 0.0;
    }
    if (svoHasAlphas && met && what.w < 0.0)
    {
      int alphas = -8 * (int(what.w) + 1);
      ends.doubtful = 0.0;
      what.w = -1.0;
      for (int start = svoHasPlanes ? 0 : 1; start < 2 && what.w < 0.0; ++start)
      {
        vec3 above = near + (start == 0 ? outside : 0.0) * localSide;
        what.w = svoTakenByColors(alphas, above, localWay, end, root, int(what.z), ends);
      }
    }
    if (met)
    {
      left *= 1.0 - max(what.w, 0.0); // else the ray only grazes it
    }
  }
  return left;
}

// What casters leave of a light (svoLightCode.h).
float svoLeft(int number, vec3 position, vec3 facet, vec3 normal, vec3 lift, float extent)
{
  vec4 source = svoLights[number];
  float end = source.w > 0.0 ? svoBeforeLight : svoFar;
  vec3 towards = normalize(source.xyz - source.w * position);
  if (dot(normal, towards) <= 0.0)
  {
    return 1.0; // it is not lit anyway
  }
  float sine = dot(facet, towards);
  bool bulges = dot(lift, lift) > 0.0;
  float left = 1.0;
  // The point itself; the way from there to the smooth surface; the point there.
  for (int step = bulges && sine < 0.0 ? 1 : 0; step < 3; ++step)
  {
    vec3 from = step == 2 ? position + lift : position;
    vec3 way = step == 1 ? lift : source.xyz - source.w * from;
    vec3 plane = step == 2 ? normal : facet;
    vec3 side = step != 1 && dot(plane, way) < 0.0 ? -plane : plane;
    way -= step != 1 ? source.w * svoAbove * side : vec3(0.0);
    left = svoLeftAlong(from, side, way, step == 1 ? 1.0 : end);
    if (step == 0 ? left > 0.0 || !bulges || sine > svoDoubtfulSine : left <= 0.0)
    {
      break;
    }
  }
  return left;
}
