//VTK::System::Dec
#if defined(SVO_WRITE_SLOPES) && defined(GL_ARB_sample_shading)
#extension GL_ARB_sample_shading : enable
#define SVO_EACH_SAMPLE
#endif
//VTK::Output::Dec
// Pixels that were traced elsewhere: colour and window depth. With SVO_WRITE_NORMALS also what
// VTK's ambient occlusion reads, the position and the normal in view coordinates; with
// SVO_WRITE_LIGHT the colour is not cut to 0..1; with SVO_WRITE_SLOPES, where OpenGL can run a
// shader for each sample of a pixel, all of these have depths of their own, as those of VTK's
// surfaces have. Textures are as large as the viewport, so that each fragment lies on the centre of
// its texel, or a sample in it; filtered look-ups cost software OpenGL less than texelFetch.
in vec2 texCoord;
uniform sampler2D colors;
uniform sampler2D depths;
#ifdef SVO_WRITE_NORMALS
uniform sampler2D normals;
uniform mat4 clipToView;
#endif
#ifdef SVO_EACH_SAMPLE
uniform sampler2D slopes;
#endif
#ifdef SVO_WRITE_LIGHT
uniform sampler2D light;
#endif
void main()
{
  vec4 color = texture(colors, texCoord);
  if (color.a == 0.0)
  {
    discard;
  }
  float depth = texture(depths, texCoord).r;
#ifdef SVO_EACH_SAMPLE
  depth += dot(texture(slopes, texCoord).rg, gl_SamplePosition - 0.5);
#endif
  gl_FragDepth = depth;
#ifdef SVO_WRITE_LIGHT
  color.rgb = texture(light, texCoord).rgb;
#endif
  gl_FragData[0] = color;
#ifdef SVO_WRITE_NORMALS
  vec4 position = clipToView * vec4(texCoord * 2.0 - 1.0, depth * 2.0 - 1.0, 1.0);
  vec3 normal = texture(normals, texCoord).xyz;
  bool lit = normal != vec3(0.0); // unlit surfaces are transparent here, as VTK's mappers have it
  gl_FragData[1] = lit ? vec4(position.xyz / position.w, 1.0) : vec4(0.0);
  gl_FragData[2] = lit ? vec4(normal, 1.0) : vec4(0.0);
#endif
}
