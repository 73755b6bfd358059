// The boxes that octrees of planes are seen in (svoEyeCode.h): of each, in svoBoxes,
//   0..2   rows of the matrix that takes the octree's coordinates to the view's; these have the
//          middle of the cube at 0, and edges of 1
//   3..5   rows of the matrix that takes directions back, beside (root / 4096, root % 4096, depths)
//   6..8   rows of the matrix that takes normals to the view's coordinates, beside (what is added to
//          window depths; svoAbove of rays to lights; 1: normals are the planes' own)
//   9, 10  svoEnds::low and reach, svoEnds::high and 1: the box is wound to the right in the window
//   11     colour, and 1: planes have colours of their own
//   12, 13 the box, beside (n / 4096, n % 4096): the texel of svoColors of word 0 of svoLists, modulo 2^32
uniform samplerBuffer svoBoxes;
uniform mat4 svoViewToClip;

const int svoTexelsOfBox = 14;

vec4 svoOfBox(int number, int texel)
{
  return texelFetch(svoBoxes, svoTexelsOfBox * number + texel);
}

int svoNumberIn(float high, float low)
{
  return int(high) * 4096 + int(low);
}

// Where a corner of a box lies, 0 or 1 along each axis of a box that is wound to the left.
vec4 svoCorner(int number, vec3 corner, out vec3 end, out vec3 viewEnd)
{
  corner.x = svoOfBox(number, 10).w > 0.0 ? 1.0 - corner.x : corner.x;
  end = mix(svoOfBox(number, 12).xyz, svoOfBox(number, 13).xyz, corner);
  vec4 point = vec4(end, 1.0);
  viewEnd = vec3(dot(svoOfBox(number, 0), point), dot(svoOfBox(number, 1), point),
    dot(svoOfBox(number, 2), point));
  return svoViewToClip * vec4(viewEnd, 1.0);
}
