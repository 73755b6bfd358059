//VTK::System::Dec
// A corner of a rectangle of the frame.
in vec2 corner; // pixels
out vec2 texCoord;
uniform vec2 frameSize; // pixels
void main()
{
  texCoord = corner / frameSize;
  gl_Position = vec4(texCoord * 2.0 - 1.0, 0.0, 1.0);
}
