// Progress on the terminal: a counter that rewrites its line, or one line a step in a log.
#ifndef PaperScenes_progress_h
#define PaperScenes_progress_h

#include <string>

namespace paper
{
class Progress
{
public:
  /// A step of @a total parts; 0 for a step of unknown length.
  Progress(const std::string& step, int total);
  ~Progress();
  Progress(const Progress&) = delete;
  void operator=(const Progress&) = delete;
  void advance();
  /// Adds the step's result behind it.
  void finish(const std::string& result);

private:
  void show() const;

  std::string Step;
  int Total;
  int Done = 0;
};
}

#endif
