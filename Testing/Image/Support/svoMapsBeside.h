// The shadow maps that OpenGL draws, compared with those that the CPU traces of the same frame.
#ifndef svoMapsBeside_h
#define svoMapsBeside_h

#include "vtkSVORenderPass.h"
#include "vtkSmartPointer.h"

#include <cstddef>

namespace svotest
{
/// What a frame's comparison has found, over all maps.
struct MapsBeside
{
  bool same = false; // number and views of the maps
  std::size_t maps = 0, texels = 0, held = 0;
  std::size_t edges = 0;  // that only one of both has something at
  std::size_t depths = 0; // at which they differ by more than OpenGL moves corners
  double worst = 0.0;
  std::size_t shares = 0;

  static MapsBeside Last;
};

/// One that compares in each frame that OpenGL's tracer makes.
vtkSmartPointer<vtkSVORenderPass> makePassBeside();
}

#endif
