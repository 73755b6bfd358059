// The program's command line.
#ifndef PaperScenes_arguments_h
#define PaperScenes_arguments_h

#include <string>
#include <vector>

namespace paper
{
struct Arguments
{
  bool standIn = false;
  std::string fileOfA;
  std::string fileOfB;
  std::string output = ".";
  std::vector<std::string> scenes; ///< empty: all
  int size[2] = { 1920, 1080 };
  int level = 10;
  int framesPerView = 10;
  int movieFrames = 450;
};

enum class Parsed
{
  Run,
  HelpShown,
  Wrong ///< a message is out
};
Parsed parseArguments(int argc, char* argv[], Arguments& arguments);
}

#endif
