//VTK::System::Dec
//VTK::Output::Dec
in vec4 partColor;
void main()
{
  gl_FragData[0] = partColor;
}
