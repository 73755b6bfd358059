// What casts, drawn from a light into one of its shadow maps: the linear depth, less the map's base, of
// what is met first at each texel's centre, and the share of the light that it takes.
//
// svoCopies has eight texels a copy. `Coordinates` are those of the octree's cube, whose middle is 0 and
// whose edges are 1, or of balls those in which their radius is 1. From there
//
//   0..3  the rows of a matrix to x, y, depth and w of the map
//   4     where rays begin, 1; or their direction, 0; coordinates
//   5     as of svoRayWalk.glsl's casters: root / 4096, root % 4096, depths, opacity, or -1 - n: where
//         its alphas begin is 8 n
//   6, 7  svoEnds::low and reach, and svoEnds::high
//
// svoShape is put before it, 0: triangles, 1: balls, 2: planes and cubes; and svoAtVertices in vertex
// shaders. In fragment shaders svoOctreeWalk.glsl and svoColorAlpha.glsl come before it.
uniform samplerBuffer svoCopies;

#ifdef svoAtVertices
uniform int svoFirstCopy;
flat out int svoCopy; // texel
#if svoShape == 0
uniform samplerBuffer svoTriangles;
uniform int svoFirstTriangle;
out float svoDepth;
out vec3 svoShares; // of the triangle's corners
#else
out vec3 svoAt;        // on a box around what is met
flat out vec3 svoSide; // which of its sides
#endif

void main()
{
  svoCopy = svoFirstCopy + 8 * gl_InstanceID;
#if svoShape == 0
  vec3 place = texelFetch(svoTriangles, 3 * svoFirstTriangle + gl_VertexID).xyz - 1.5;
  int corner = gl_VertexID % 3;
  svoShares = vec3(corner == 0, corner == 1, corner == 2);
#else
  const int corners[6] = int[6](0, 1, 2, 2, 1, 3);
  int axis = gl_VertexID / 12;
  int corner = corners[gl_VertexID % 6];
  int upper = gl_VertexID / 6 % 2;
  vec3 part = vec3(0.0);
  part[axis] = float(upper);
  part[(axis + 1) % 3] = float(corner & 1);
  part[(axis + 2) % 3] = float(corner >> 1);
  svoSide = vec3(0.0);
  svoSide[axis] = float(2 * upper - 1);
#if svoShape == 1
  vec3 place = 1.001 * (2.0 * part - 1.0);
#else
  // A voxel around it.
  vec4 what = texelFetch(svoCopies, svoCopy + 5);
  float voxel = 1.0 / float(1 << (2 * int(what.z)));
  vec3 low = max(texelFetch(svoCopies, svoCopy + 6).xyz - voxel, vec3(0.999)) - 1.5;
  vec3 high = min(texelFetch(svoCopies, svoCopy + 7).xyz + voxel, vec3(2.001)) - 1.5;
  vec3 place = mix(low, high, part);
#endif
  svoAt = place;
#endif
  vec4 at = vec4(place, 1.0);
#if svoShape == 0
  svoDepth = dot(texelFetch(svoCopies, svoCopy + 2), at);
#endif
  // Nothing is cut at the near or the far plane, which would take what floats have for depths.
  gl_Position = vec4(dot(texelFetch(svoCopies, svoCopy), at),
    dot(texelFetch(svoCopies, svoCopy + 1), at), 0.0, dot(texelFetch(svoCopies, svoCopy + 3), at));
}

#else
uniform vec2 svoReach; // the least and the greatest depth that there is
flat in int svoCopy;
out vec4 svoTexel;

#if svoShape == 0
uniform int svoFirstTriangle;
in float svoDepth;
in vec3 svoShares;

bool svoMeetsCaster(vec4 what, out float depth)
{
  depth = svoDepth;
  svoHit = uint(svoFirstTriangle + gl_PrimitiveID);
  svoWeights = svoShares;
  return true;
}
#else
in vec3 svoAt;
flat in vec3 svoSide;

bool svoMeetsCaster(vec4 what, out float depth)
{
  vec4 source = texelFetch(svoCopies, svoCopy + 4);
  vec3 way = source.w > 0.0 ? svoAt - source.xyz : source.xyz;
  if (dot(svoSide, way) <= 0.0) // but where the ray leaves the box
  {
    return false;
  }
  // Back to where it begins, or to before the box.
  float back = (svoShape == 1 ? 4.0 : 2.0) / length(way);
  back = source.w > 0.0 ? min(back, 1.0) : back;
#if svoShape == 1
  // How far before svoAt it is nearest to the middle, and from there to the surface.
  float size = dot(way, way);
  float nearest = dot(svoAt, way) / size;
  vec3 beside = svoAt - nearest * way;
  float rest = 1.0 - dot(beside, beside);
  float half_ = sqrt(max(rest, 0.0) / size);
  float before = nearest + half_ <= back ? nearest + half_ : nearest - half_;
  bool met = rest >= 0.0 && before <= back;
#else
  vec4 low = texelFetch(svoCopies, svoCopy + 6);
  svoEnds ends = svoEnds(low.xyz, texelFetch(svoCopies, svoCopy + 7).xyz, low.w, 0.0);
  bool met = svoMeetsOctree(svoAt + 1.5 - back * way, way, 1.001 * back,
    uint(what.x) * 4096u + uint(what.y), int(what.z), ends);
  float before = back - svoHitAt;
#endif
  depth = dot(texelFetch(svoCopies, svoCopy + 2), vec4(svoAt - before * way, 1.0));
  return met;
}
#endif

void main()
{
  vec4 what = texelFetch(svoCopies, svoCopy + 5);
  float depth;
  if (!svoMeetsCaster(what, depth))
  {
    discard;
  }
  float taken = svoHasAlphas && what.w < 0.0 ? svoTakenByHit(-8 * (int(what.w) + 1)) : what.w;
  svoTexel = vec4(depth, taken, 0.0, 1.0);
  gl_FragDepth = clamp((depth - svoReach.x) / (svoReach.y - svoReach.x), 0.0, 1.0);
}
#endif
