//VTK::System::Dec
// A rectangle of the viewport; `rectangle` is its lower left and upper right corner, 0..1.
in vec4 ndCoordIn;
in vec2 texCoordIn;
out vec2 texCoord;
uniform vec4 rectangle;
void main()
{
  texCoord = mix(rectangle.xy, rectangle.zw, texCoordIn);
  vec2 place = mix(rectangle.xy, rectangle.zw, ndCoordIn.xy * 0.5 + 0.5);
  gl_Position = vec4(place * 2.0 - 1.0, 0.0, 1.0);
}
