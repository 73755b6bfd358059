#include "svoTraceSettings.h"

#include "svoLayout.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace svobench
{
bool readSettings(int argc, char** argv, TraceSettings& settings)
{
  for (int i = 1; i < argc; ++i)
  {
    const std::string a = argv[i];
    const char* value = i + 1 < argc ? argv[i + 1] : "";
    if (a == "--scalar")
    {
      settings.scalar = true;
      continue;
    }
    if (a == "--a" || a == "--b" || a == "--ball" || a.compare(0, 2, "--") != 0)
    {
      std::string error;
      if (!readArgument(argc, argv, i, settings.meshes, error))
      {
        std::fprintf(stderr, "BenchmarkTrace: %s\n", error.c_str());
        return false;
      }
      continue;
    }
    ++i;
    if (a == "--levels")
    {
      settings.levels.clear();
      for (const char* p = value; *p; p += *p == ',')
      {
        char* end = nullptr;
        settings.levels.push_back(static_cast<int>(std::strtol(p, &end, 10)));
        if (end == p || settings.levels.back() < 1 || settings.levels.back() > svo::MaximumLevel)
        {
          return false;
        }
        p = end;
      }
    }
    else if (a == "--size")
    {
      if (std::sscanf(value, "%dx%d", &settings.width, &settings.height) != 2 ||
        settings.width < 8 || settings.height < 8)
      {
        return false;
      }
    }
    else if (a == "--repeat")
    {
      settings.repeat = std::max(std::atoi(value), 1);
    }
    else if (a == "--instances")
    {
      settings.instances = std::max(std::atoi(value), 0);
    }
    else if (a == "--isa")
    {
      settings.isa = value;
    }
    else if (a == "--json")
    {
      settings.json = value;
    }
    else
    {
      return false;
    }
  }
  return true;
}
}
