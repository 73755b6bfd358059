// How much of a light reaches a fragment of a rasterised surface (svoLightCode.h), by a ray from there
// through the octrees of all that casts, by the rules of svoShadowRays.cxx and svoTerminator.h.
//
// svoCasters holds a tree of the casters' boxes, two texels a node, in the order in which it is
// walked: (lower corner, node after all that is below), (upper corner, caster or -1). Behind it, from
// svoFirstCaster on, six texels a caster: the rows of the matrix that takes view coordinates to octree
// coordinates; (root / 4096, root % 4096, depths, opacity, or -1 - n: what follows from 8 n on in
// svoAlphas; svoCasterAlphas.h); and of octrees of planes (lower corner of
// what they show, how far planes are seen from a voxel's centre), (upper corner, how far planes may lie
// over what VTK draws in their place), octree coordinates and voxels. Boxes are in a frame of their own, svoViewToTree.
//
// svoNodes holds nodes as svoLayout.h has them (mask, mask, first child, list) with the whole arena's
// numbers. `list` is where the node's triangles begin in svoLists (count, id, id, ...), or has
// svoSingle set and is the only one's id; svoNone: its children have them; svoOfPlanes: it is a brick
// whose voxels have planes (svoPlane.h), in svoLists from the first child on. svoTriangles has three
// texels a triangle: its corners, octree coordinates.
//
// Constants are put before it: svoLightCount, svoDoubtfulSine, and whether there are octrees of planes,
// and casters whose colours have alpha: to ask for them takes time even where there are none.
uniform usamplerBuffer svoNodes;
uniform usamplerBuffer svoLists;
uniform samplerBuffer svoTriangles;
uniform samplerBuffer svoCasters;
uniform samplerBuffer svoAlphas;
uniform int svoTreeSize;    // nodes
uniform int svoFirstCaster; // texel
uniform mat4 svoViewToTree;
uniform vec4 svoLights[svoLightCount]; // view coordinates: (towards it, 0), or (its place, 1)

const uint svoNone = 0xffffffffu;
const uint svoOfPlanes = 0xfffffffeu;
const uint svoSingle = 0x80000000u;
const float svoFar = 1e30;
const float svoBeforeLight = 0.99999; // where rays to a light at 1 end
const int svoMostSteps = 4096;        // of a ray in one octree

// What floats resolve of a position that a rasteriser has interpolated, by its size.
const float svoPositionError = 1e-6;
// ... and of a place in an octree, by its distance from the cube's corner.
const float svoOctreeError = 6e-7;

// A ray through one octree, from where it enters the cube, made ready for triangles: `across`, `up`
// and `direction` are a frame in which it goes along the third axis.
struct svoRay
{
  vec3 origin;
  vec3 direction;
  vec3 across;
  vec3 up;
  float end;
};

// Where the planes of an octree are seen (svoCasters), and before which end of a ray they are not
// believed.
struct svoEnds
{
  vec3 low;
  vec3 high;
  float reach;
  float doubtful;
};
bool svoDoubted; // a ray has met one that is not

// What a ray has met: the plane, or while svoNearest is true, where a walk goes on to the first one, the
// triangle and the weights of its corners.
bool svoNearest = false;
uint svoHit;
vec3 svoWeights;

// Unit vectors as an octahedron's surface (Cigolle et al. 2014, "A Survey of Efficient Representations
// for Independent Unit Vectors").
vec3 svoUnfold(vec2 folded)
{
  vec3 way = vec3(folded, 1.0 - abs(folded.x) - abs(folded.y));
  float below = max(-way.z, 0.0);
  way.xy += vec2(way.x < 0.0 ? below : -below, way.y < 0.0 ? below : -below);
  return normalize(way);
}

int svoBits(uint x)
{
  x = x - ((x >> 1) & 0x55555555u);
  x = (x & 0x33333333u) + ((x >> 2) & 0x33333333u);
  x = (x + (x >> 4)) & 0x0f0f0f0fu;
  return int((x * 0x01010101u) >> 24);
}

// True if the ray meets the triangle. Edges are as wide as floats make them, so that no ray passes
// between two triangles, whatever a compiler contracts.
bool svoMeets(inout svoRay ray, uint triangle)
{
  int at = 3 * int(triangle);
  vec3 a = texelFetch(svoTriangles, at).xyz - ray.origin;
  vec3 b = texelFetch(svoTriangles, at + 1).xyz - ray.origin;
  vec3 c = texelFetch(svoTriangles, at + 2).xyz - ray.origin;
  vec3 x = vec3(dot(ray.across, a), dot(ray.across, b), dot(ray.across, c));
  vec3 y = vec3(dot(ray.up, a), dot(ray.up, b), dot(ray.up, c));
  vec3 p = x.zxy * y.yzx;
  vec3 q = y.zxy * x.yzx;
  vec3 edges = p - q;
  vec3 error = 2.4e-7 * (abs(p) + abs(q));
  float sum = edges.x + edges.y + edges.z;
  vec3 inside = sum < 0.0 ? -edges : edges;
  if (sum == 0.0 || any(lessThan(inside, -error)))
  {
    return false;
  }
  vec3 z = vec3(dot(ray.direction, a), dot(ray.direction, b), dot(ray.direction, c));
  float t = dot(edges, z) / (sum * dot(ray.direction, ray.direction));
  bool met = t >= 0.0 && t <= ray.end;
  if (svoHasAlphas && svoNearest && met)
  {
    ray.end = t;
    svoHit = triangle;
    svoWeights = max(inside, vec3(0.0));
    return false;
  }
  return met;
}

bool svoMeetsAny(inout svoRay ray, uint list)
{
  if ((list & svoSingle) != 0u)
  {
    return svoMeets(ray, list & ~svoSingle);
  }
  int count = int(texelFetch(svoLists, int(list)).r);
  for (int k = 1; k <= count; ++k)
  {
    if (svoMeets(ray, texelFetch(svoLists, int(list) + k).r))
    {
      return true;
    }
  }
  return false;
}

// True if a ray, in voxels, meets the plane of one: where that passes the voxel, or is near.
bool svoMeetsPlane(
  svoRay ray, vec3 start, vec3 speed, ivec3 place, uint number, svoEnds ends, float cells)
{
  uint plane = texelFetch(svoLists, int(number)).r;
  vec2 folded = vec2(plane & 2047u, (plane >> 11) & 2047u) / 2047.0 * 2.0 - 1.0;
  float offset = float(plane >> 22) / 1023.0 * 2.0 - 1.0;
  vec3 normal = svoUnfold(folded);
  vec3 centre = vec3(place) + 0.5 - start;
  float t = (dot(normal, centre) + 0.8660254 * offset) / dot(normal, speed);
  vec3 away = t * speed - centre;
  vec3 at = 1.0 + (start + t * speed) / cells;
  bool met = t >= 0.0 && t <= ray.end && all(lessThanEqual(abs(away), vec3(ends.reach))) &&
    all(greaterThanEqual(at, ends.low)) && all(lessThanEqual(at, ends.high));
  svoDoubted = svoDoubted || (met && t < ends.doubtful);
  met = met && t >= ends.doubtful;
  svoHit = svoHasAlphas && met ? number : svoHit;
  return met;
}

// True if a ray from `from` along `way`, up to `end` times as far, meets a triangle of an octree, or
// a plane; octree coordinates.
bool svoMeetsOctree(vec3 from, vec3 way, float end, uint root, int depths, svoEnds ends)
{
  // No direction is 0: a ray along a plane between cells would never leave it.
  float least = 1e-12 * max(max(abs(way.x), abs(way.y)), abs(way.z));
  vec3 forwards = vec3(way.x < 0.0 ? -1.0 : 1.0, way.y < 0.0 ? -1.0 : 1.0, way.z < 0.0 ? -1.0 : 1.0);
  vec3 inverse = 1.0 / (forwards * max(abs(way), vec3(least)));
  vec3 low = (1.0 - from) * inverse;
  vec3 high = (2.0 - from) * inverse;
  vec3 enters = min(low, high);
  vec3 leaves = max(low, high);
  float first = max(max(max(enters.x, enters.y), enters.z), 0.0);
  float last = min(min(min(leaves.x, leaves.y), leaves.z), end);
  if (!(first <= last))
  {
    return false;
  }
  svoRay ray;
  // On a face exactly, and then from there: a flattened cube is so far away for its height that floats
  // do not tell where the ray enters and leaves.
  ray.origin = mix(from + first * way, 1.5 - 0.5 * forwards, equal(enters, vec3(first)));
  ray.direction = way;
  vec3 size = abs(way);
  vec3 axis = size.x < size.y ? (size.x < size.z ? vec3(1, 0, 0) : vec3(0, 0, 1))
                              : (size.y < size.z ? vec3(0, 1, 0) : vec3(0, 0, 1));
  ray.across = normalize(cross(way, axis));
  ray.up = normalize(cross(way, ray.across));
  ray.end = end - first;
  ends.doubtful -= first;
  leaves = (1.5 + 0.5 * forwards - ray.origin) * inverse;
  last = min(min(min(leaves.x, leaves.y), leaves.z), ray.end);

  // Places in whole numbers: the cells of the last depth along an edge of the cube are 2^bits.
  int bits = 2 * depths;
  float cells = float(1 << bits);
  vec3 start = (ray.origin - 1.0) * cells; // in cells
  vec3 speed = way * cells;
  vec3 slowness = inverse / cells;
  ivec3 most = ivec3((1 << bits) - 1);
  ivec3 place = clamp(ivec3(floor(start)), ivec3(0), most);
  ivec3 ahead = ivec3(way.x < 0.0 ? 0 : 1, way.y < 0.0 ? 0 : 1, way.z < 0.0 ? 0 : 1);

  uint path[10]; // nodes from the root on
  int depth = 0;
  uint node = root;
  uvec4 record = texelFetch(svoNodes, int(node));
  if (record.w < svoOfPlanes)
  {
    return svoMeetsAny(ray, record.w);
  }
  for (int step = 0; step < svoMostSteps; ++step)
  {
    int shift = bits - 2 - 2 * depth;
    ivec3 cell = (place >> shift) & 3;
    // Morton order: z y x z y x from the highest bit.
    int group = ((cell.z >> 1) << 2) | ((cell.y >> 1) << 1) | (cell.x >> 1);
    int inGroup = ((cell.z & 1) << 2) | ((cell.y & 1) << 1) | (cell.x & 1);
    int number = 8 * group + inGroup;
    uint half_ = number < 32 ? record.x : record.y;
    uint bit = 1u << uint(number & 31);
    if ((half_ & bit) != 0u)
    {
      uint child = record.z + uint(svoBits(half_ & (bit - 1u))) +
        (number < 32 ? 0u : uint(svoBits(record.x)));
      bool plane = svoHasPlanes && record.w == svoOfPlanes;
      uvec4 below = plane ? uvec4(0u) : texelFetch(svoNodes, int(child));
      if (!plane && below.w >= svoOfPlanes)
      {
        path[depth] = node;
        ++depth;
        node = child;
        record = below;
        continue;
      }
      if (plane ? svoMeetsPlane(ray, start, speed, place, child, ends, cells)
                : svoMeetsAny(ray, below.w))
      {
        return true;
      }
      last = svoHasAlphas ? min(last, ray.end) : last;
    }
    else if (((half_ >> uint(number & 24)) & 0xffu) == 0u)
    {
      ++shift; // none of its eight cells
    }
    // On to where the ray leaves the cell.
    ivec3 corner = (place >> shift) << shift;
    vec3 exits = (vec3(corner + ahead * (1 << shift)) - start) * slowness;
    float t = min(min(exits.x, exits.y), exits.z);
    if (t > last)
    {
      return false;
    }
    ivec3 next = clamp(ivec3(floor(start + t * speed)), corner, corner + (1 << shift) - 1);
    next.x = exits.x == t ? corner.x + (ahead.x == 1 ? 1 << shift : -1) : next.x;
    next.y = exits.y == t ? corner.y + (ahead.y == 1 ? 1 << shift : -1) : next.y;
    next.z = exits.z == t ? corner.z + (ahead.z == 1 ? 1 << shift : -1) : next.z;
    if (any(lessThan(next, ivec3(0))) || any(greaterThan(next, most)))
    {
      return false;
    }
    ivec3 changed = next ^ place;
    int differs = changed.x | changed.y | changed.z;
    place = next;
    int above = depth;
    while (above > 0 && (differs >> (bits - 2 * above)) != 0)
    {
      --above;
    }
    if (above != depth)
    {
      depth = above;
      node = path[depth];
      record = texelFetch(svoNodes, int(node));
    }
  }
  return false;
}

// The share that a caster whose colours have alpha takes of a ray: where that meets it first, seen from
// the light, or from beyond the octree.
float svoTakenByColors(int at, vec3 from, vec3 way, float end, uint root, int depths, svoEnds ends)
{
  float far = min(end, (distance(from, vec3(1.5)) + 1.0) / length(way)); // the cube is 1..2
  svoHit = svoNone;
  svoNearest = true;
  svoMeetsOctree(from + far * way, -way, far, root, depths, ends);
  svoNearest = false;
  if (svoHit == svoNone)
  {
    return -1.0;
  }
  int stride = int(texelFetch(svoAlphas, at + 1).r);
  int first = 4096 * int(texelFetch(svoAlphas, at + 2).r) + int(texelFetch(svoAlphas, at + 3).r);
  int texels = int(texelFetch(svoAlphas, at + 4).r);
  int value = at + 8 + 2 * texels + stride * (int(svoHit) - first);
  float alpha = texelFetch(svoAlphas, value).r;
  if (stride > 1)
  {
    svoWeights /= svoWeights.x + svoWeights.y + svoWeights.z;
    alpha = dot(svoWeights,
      vec3(alpha, texelFetch(svoAlphas, value + 1).r, texelFetch(svoAlphas, value + 2).r));
  }
  if (stride > 3)
  {
    float row = dot(svoWeights,
      vec3(texelFetch(svoAlphas, value + 3).r, texelFetch(svoAlphas, value + 4).r,
        texelFetch(svoAlphas, value + 5).r));
    int texel = min(int(clamp(alpha, 0.0, 1.0) * float(texels)), texels - 1);
    alpha = texelFetch(svoAlphas, at + 8 + texel + (row < 0.5 ? 0 : texels)).r;
  }
  return texelFetch(svoAlphas, at).r * clamp(alpha, 0.0, 1.0);
}

// What casters leave on the way from `from` along `way`, up to `end` times as far: 0 where an opaque
// one is met. The ray starts beside its surface, along `side`, by what floats resolve.
float svoLeftAlong(vec3 from, vec3 side, vec3 way, float end)
{
  float left = 1.0;
  vec3 start = from + svoPositionError * length(from) * side;
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
    localSide = normalize(localSide);
    // (No point of its surface lies beyond the cube, at 2.)
    float corner = max(max(abs(local.x), abs(local.y)), abs(local.z));
    local += svoOctreeError * clamp(corner, 1.0, 2.0) * localSide;
    // A ray may start behind the planes of its own surface. What it meets before it can have left
    // them has to be met from outside of them too (ShadowRays::blocks()).
    float outside = high.w / float(1 << (2 * int(what.z)));
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
    left = svoLeftAlong(from, side, way, step == 1 ? 1.0 : end);
    if (step == 0 ? left > 0.0 || !bulges || sine > svoDoubtfulSine : left <= 0.0)
    {
      break;
    }
  }
  return left;
}
