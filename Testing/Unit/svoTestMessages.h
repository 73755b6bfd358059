// Counts the errors and warnings of a VTK object, for tests that expect exactly one.
#ifndef svoTestMessages_h
#define svoTestMessages_h

#include "vtkCommand.h"
#include "vtkObject.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

namespace svo
{
class TestMessages
{
public:
  explicit TestMessages(vtkObject* object)
  {
    this->Listener = vtkSmartPointer<Observer>::New();
    this->Listener->messages = this;
    object->AddObserver(vtkCommand::ErrorEvent, this->Listener);
    object->AddObserver(vtkCommand::WarningEvent, this->Listener);
  }
  ~TestMessages() { this->Listener->messages = nullptr; }
  TestMessages(const TestMessages&) = delete;
  void operator=(const TestMessages&) = delete;

  std::vector<std::string> errors;
  std::vector<std::string> warnings;

  std::string all() const
  {
    std::string text;
    for (const auto* list : { &this->errors, &this->warnings })
    {
      for (const std::string& message : *list)
      {
        text += message;
      }
    }
    return text;
  }

private:
  struct Observer : vtkCommand
  {
    static Observer* New() { return new Observer; }
    void Execute(vtkObject*, unsigned long event, void* data) override
    {
      if (this->messages)
      {
        (event == vtkCommand::ErrorEvent ? this->messages->errors : this->messages->warnings)
          .emplace_back(static_cast<const char*>(data));
      }
    }
    TestMessages* messages = nullptr;
  };
  vtkSmartPointer<Observer> Listener;
};
}

#endif
