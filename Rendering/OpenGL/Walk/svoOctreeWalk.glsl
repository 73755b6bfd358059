// A ray through one octree, to whatever it meets first or at all: by lights and by the eye. May stand
// twice in a shader.
//
// svoNodes holds nodes as svoLayout.h has them (mask, mask, first child, list) with the whole arena's
// numbers. `list` is where the node's triangles begin in svoLists (count, id, id, ...), or has
// svoSingle set and is the only one's id; svoNone: its children have them; svoOfPlanes: it is a brick
// whose voxels have planes (svoPlane.h), in svoLists from the first child on. svoTriangles has three
// texels a triangle: its corners, octree coordinates.
//
// svoHasPlanes and svoHasAlphas are put before it: whether there are octrees of planes, and casters
// whose colours have alpha. To ask for them takes time even where there are none.
#ifndef svoOctreeWalk
#define svoOctreeWalk
uniform usamplerBuffer svoNodes;
uniform usamplerBuffer svoLists;
uniform samplerBuffer svoTriangles;

const uint svoNone = 0xffffffffu;
const uint svoOfPlanes = 0xfffffffeu;
const uint svoSingle = 0x80000000u;
const int svoMostSteps = 4096;        // of a ray in one octree

// A ray through one octree, from where it enters the cube, made ready for triangles: `across`, `up`
// and `direction` are axes; it goes along the third.
struct svoRay
{
  vec3 origin;
  vec3 direction;
  vec3 across;
  vec3 up;
  float end;
};

// Where the planes of an octree are seen: in which box, octree coordinates, and how far from their
// voxels' centres, voxels, or below 0, that voxels are cubes instead; and before which end of a ray they
// are not believed.
struct svoEnds
{
  vec3 low;
  vec3 high;
  float reach;
  float doubtful;
};
bool svoDoubted = false; // a ray has met one that is not

// What a ray has met: the plane, and how far along the ray, or while svoNearest is true, where a walk
// goes on to the first one, the triangle and the weights of its corners.
bool svoNearest = false;
uint svoHit;
float svoHitAt = 0.0;
vec3 svoWeights;

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

vec3 svoNormalOf(uint plane)
{
  return svoUnfold(vec2(plane & 2047u, (plane >> 11) & 2047u) / 2047.0 * 2.0 - 1.0);
}

// True if a ray, in voxels, meets the plane of one: where that passes the voxel, or is near.
bool svoMeetsPlane(
  svoRay ray, vec3 start, vec3 speed, ivec3 place, uint number, svoEnds ends, float cells)
{
  uint plane = texelFetch(svoLists, int(number)).r;
  float offset = float(plane >> 22) / 1023.0 * 2.0 - 1.0;
  vec3 normal = svoNormalOf(plane);
  vec3 centre = vec3(place) + 0.5 - start;
  float t = (dot(normal, centre) + 0.8660254 * offset) / dot(normal, speed);
  vec3 away = t * speed - centre;
  vec3 at = 1.0 + (start + t * speed) / cells;
  bool met = t >= 0.0 && t <= ray.end && all(lessThanEqual(abs(away), vec3(ends.reach))) &&
    all(greaterThanEqual(at, ends.low)) && all(lessThanEqual(at, ends.high));
  svoDoubted = svoDoubted || (met && t < ends.doubtful);
  met = met && t >= ends.doubtful;
  svoHit = met ? number : svoHit;
  svoHitAt = met ? t : svoHitAt;
  return met;
}

// The same of a voxel that is a cube, where the ray enters it.
bool svoMeetsCube(float entered, uint number, svoEnds ends)
{
  svoHit = number;
  svoHitAt = entered;
  svoDoubted = svoDoubted || entered < ends.doubtful;
  return entered >= ends.doubtful;
}

// The number of a node's child by its place among 4x4x4, in Morton order: z y x z y x from the highest bit.
int svoNumberOf(ivec3 cell)
{
  int group = ((cell.z >> 1) << 2) | ((cell.y >> 1) << 1) | (cell.x >> 1);
  return 8 * group + (((cell.z & 1) << 2) | ((cell.y & 1) << 1) | (cell.x & 1));
}

// A child that is there: the node, or the word of svoLists that is its plane.
uint svoChildOf(uvec4 record, int number)
{
  uint before = (1u << uint(number & 31)) - 1u;
  return record.z +
    (number < 32 ? uint(svoBits(record.x & before))
                 : uint(svoBits(record.x)) + uint(svoBits(record.y & before)));
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
  float entered = 0.0; // the cell
  for (int step = 0; step < svoMostSteps; ++step)
  {
    int shift = bits - 2 - 2 * depth;
    int number = svoNumberOf((place >> shift) & 3);
    uint half_ = number < 32 ? record.x : record.y;
    if ((half_ & (1u << uint(number & 31))) != 0u)
    {
      uint child = svoChildOf(record, number);
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
      if (!plane           ? svoMeetsAny(ray, below.w)
          : ends.reach < 0.0 ? svoMeetsCube(entered, child, ends)
                             : svoMeetsPlane(ray, start, speed, place, child, ends, cells))
      {
        svoHitAt += first;
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
    entered = t;
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
#endif
