// What BenchmarkTrace is asked for.
#ifndef svoTraceSettings_h
#define svoTraceSettings_h

#include "svoBenchmarkMesh.h"

#include <string>
#include <vector>

namespace svobench
{
struct TraceSettings
{
  std::vector<int> levels{ 8, 10, 12 };
  int width = 640;
  int height = 360;
  int repeat = 9;
  int instances = 0;
  bool scalar = false;
  std::string isa;
  std::string json;
  std::vector<Mesh> meshes;
};

/// False if the arguments make no sense.
bool readSettings(int argc, char** argv, TraceSettings& settings);
}

#endif
