// Parses the program's command line.
#include "arguments.h"

#include "experiments.h"

#include <vtksys/CommandLineArguments.hxx>

#include <algorithm>
#include <iostream>
#include <sstream>

namespace paper
{
namespace
{
bool validate(const Arguments& arguments, std::string& error)
{
  if (!arguments.standIn && (arguments.fileOfA.empty() || arguments.fileOfB.empty()))
  {
    error = "give the meshes with --a and --b, or use --stand-in.";
  }
  else if (arguments.size[0] < 1 || arguments.size[1] < 1)
  {
    error = "--size takes a width and a height of at least 1, as in 1920x1080.";
  }
  else if (arguments.level < 1 || arguments.level > 20)
  {
    error = "--level takes 1 to 20.";
  }
  else if (arguments.framesPerView < 0 || arguments.movieFrames < 0)
  {
    error = "--frames and --movie-frames take numbers of at least 0.";
  }
  for (const std::string& name : arguments.scenes)
  {
    const auto& known = experiments();
    if (std::none_of(known.begin(), known.end(),
          [&](const Experiment& experiment) { return experiment.name == name; }))
    {
      error = "there is no scene \"" + name +
        "\"; there are paper1a, paper1b, paper2, paper3, "
        "paper4.";
    }
  }
  return error.empty();
}
}

Parsed parseArguments(int argc, char* argv[], Arguments& arguments)
{
  using Options = vtksys::CommandLineArguments;
  std::string scenes;
  std::string size;
  bool help = false;
  Options options;
  options.Initialize(argc, argv);
  options.AddArgument("--a", Options::SPACE_ARGUMENT, &arguments.fileOfA,
    "File of object A (ChineseDragon-10kv.off), any format that Assimp reads");
  options.AddArgument("--b", Options::SPACE_ARGUMENT, &arguments.fileOfB,
    "File of object B (sydney.md2), with key frames");
  options.AddArgument(
    "--stand-in", Options::NO_ARGUMENT, &arguments.standIn, "Generated objects in place of files");
  options.AddArgument("--output", Options::SPACE_ARGUMENT, &arguments.output,
    "Folder for pictures, movie frames and figures.json (default: the current one)");
  options.AddArgument("--scenes", Options::SPACE_ARGUMENT, &scenes,
    "Comma-separated: paper1a,paper1b,paper2,paper3,paper4 (default: all)");
  options.AddArgument(
    "--size", Options::SPACE_ARGUMENT, &size, "Size of the picture (default: 1920x1080)");
  options.AddArgument(
    "--level", Options::SPACE_ARGUMENT, &arguments.level, "Octree level, 1 to 20 (default: 10)");
  options.AddArgument("--frames", Options::SPACE_ARGUMENT, &arguments.framesPerView,
    "Timed frames for each method and viewpoint (default: 10; 0 times nothing)");
  options.AddArgument("--movie-frames", Options::SPACE_ARGUMENT, &arguments.movieFrames,
    "Frames of the movie, 25 a second, over all scenes (default: 450; 0 for none)");
  options.AddArgument("--help", Options::NO_ARGUMENT, &help, "Show this text");

  const bool understood = options.Parse() != 0;
  if (help)
  {
    std::cout << "Renders the paper's experiments: pictures, movie frames, a table of figures.\n"
              << options.GetHelp();
    return Parsed::HelpShown;
  }
  std::string error;
  if (!understood)
  {
    error = "that command line was not understood; see --help.";
  }
  char separator = 0;
  char rest = 0;
  std::istringstream sizeText(size);
  if (!size.empty() &&
    (!(sizeText >> arguments.size[0] >> separator >> arguments.size[1]) || separator != 'x' ||
      sizeText >> rest))
  {
    arguments.size[0] = 0;
  }
  std::istringstream sceneText(scenes);
  for (std::string name; std::getline(sceneText, name, ',');)
  {
    arguments.scenes.push_back(name);
  }
  if (!error.empty() || !validate(arguments, error))
  {
    std::cerr << "PaperScenes: " << error << "\n";
    return Parsed::Wrong;
  }
  return Parsed::Run;
}
}
