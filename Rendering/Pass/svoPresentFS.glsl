//VTK::System::Dec
//VTK::Output::Dec
// Pixels that were traced elsewhere: colour and window depth, and what VTK's ambient occlusion
// reads, the position and the normal in view coordinates.
in vec2 texCoord;
uniform sampler2D colors;
uniform sampler2D depths;
uniform sampler2D normals;
uniform vec2 frameSize; // pixels
uniform mat4 clipToView;
void main()
{
  ivec2 pixel = ivec2(texCoord * frameSize);
  vec4 color = texelFetch(colors, pixel, 0);
  if (color.a == 0.0)
  {
    discard;
  }
  float depth = texelFetch(depths, pixel, 0).r;
  gl_FragDepth = depth;
  gl_FragData[0] = color;
  vec4 position = clipToView * vec4(texCoord * 2.0 - 1.0, depth * 2.0 - 1.0, 1.0);
  gl_FragData[1] = vec4(position.xyz / position.w, 1.0);
  gl_FragData[2] = vec4(texelFetch(normals, pixel, 0).xyz, 1.0);
}
