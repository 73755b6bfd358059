//VTK::System::Dec
// What a surface covers of a pixel: a point of a pixel's size on its centre.
in vec2 pixel;
in float depth; // window depth
in vec4 color;
out vec4 partColor;
uniform vec2 frameSize; // pixels
void main()
{
  partColor = color;
  gl_Position = vec4((pixel + 0.5) / frameSize * 2.0 - 1.0, depth * 2.0 - 1.0, 1.0);
}
