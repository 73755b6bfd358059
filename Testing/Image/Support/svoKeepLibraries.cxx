// For sanitizer builds: libraries stay loaded to the end. OpenGL drivers are closed before leaks
// are looked for, and code that is gone has no name that a suppression could name.
extern "C" int dlclose(void*)
{
  return 0;
}
