// Progress on the terminal.
#include "progress.h"

#include <unistd.h>

#include <iostream>

namespace paper
{
Progress::Progress(const std::string& step, int total)
  : Step(step)
  , Total(total)
{
  if (isatty(STDERR_FILENO))
  {
    this->show();
  }
  else
  {
    std::cerr << "  " << this->Step << std::endl;
  }
}

Progress::~Progress()
{
  if (isatty(STDERR_FILENO))
  {
    std::cerr << std::endl;
  }
}

void Progress::advance()
{
  ++this->Done;
  if (isatty(STDERR_FILENO))
  {
    this->show();
  }
}

void Progress::finish(const std::string& result)
{
  std::cerr << "    " << result;
  if (!isatty(STDERR_FILENO))
  {
    std::cerr << std::endl;
  }
}

void Progress::show() const
{
  std::cerr << "\r  " << this->Step;
  if (this->Total > 0)
  {
    std::cerr << "  " << this->Done << "/" << this->Total;
  }
  std::cerr << std::flush;
}
}
