// How deep the octrees of an instance have to be for a frame.
#ifndef svoLevels_h
#define svoLevels_h

namespace svo
{
/// Levels of an instance's octrees.
struct NeededLevels
{
  int eye = 1;
  int lights = 0; // 0: the instance is in no shadow buffer
};
}

#endif
