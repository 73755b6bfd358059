// Asks svoAnswerAt() for all pixels (svoPixelProgram.h), by compute shaders or by fragments. Before it
// comes the constant svoFormat, that of what is filled; and svoAdds where answers are added to what
// is there.
#ifdef svoComputes
layout(local_size_x = 8, local_size_y = 8) in;
#ifdef svoAdds
layout(svoFormat) uniform image2D svoMask;
#else
layout(svoFormat) writeonly uniform image2D svoMask;
#endif
uniform int svoFirstRow;

void main()
{
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, svoFirstRow);
  if (all(lessThan(pixel, imageSize(svoMask))))
  {
    vec4 answer = svoAnswerAt(pixel);
#ifdef svoAdds
    answer += imageLoad(svoMask, pixel);
#endif
    imageStore(svoMask, pixel, answer);
  }
}
#else
out vec4 svoMask;

void main()
{
  svoMask = svoAnswerAt(ivec2(gl_FragCoord.xy));
}
#endif
