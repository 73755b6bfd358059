// A call that is made once the interactor of a window has nothing else to do.
#ifndef svoIdleCall_h
#define svoIdleCall_h

#include "vtkCommand.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkWeakPointer.h"

#include <functional>
#include <utility>

namespace svo
{
/// One call at a time.
class IdleCall
{
public:
  IdleCall() = default;
  ~IdleCall() { this->cancel(); }
  IdleCall(const IdleCall&) = delete;
  IdleCall& operator=(const IdleCall&) = delete;

  /// True if a window on the screen has an interactor that knows timers. Whether its loop runs
  /// nobody can tell.
  bool may(vtkRenderWindow* window)
  {
    vtkRenderWindowInteractor* interactor = window->GetInteractor();
    if (window->GetOffScreenRendering() || !interactor || !interactor->GetInitialized())
    {
      return false;
    }
    if (interactor != this->Tried)
    {
      this->Tried = interactor;
      const int timer = interactor->CreateOneShotTimer(Wait);
      this->Knows = timer > 0;
      interactor->DestroyTimer(timer);
    }
    return this->Knows;
  }

  /// Once the interactor of a window that may() comes to it. In the place of a call that has not
  /// been made yet.
  void ask(vtkRenderWindow* window, std::function<void()> call)
  {
    this->cancel();
    if (this->may(window))
    {
      vtkRenderWindowInteractor* interactor = window->GetInteractor();
      this->Call = std::move(call);
      this->Interactor = interactor;
      this->Observer = interactor->AddObserver(vtkCommand::TimerEvent, this, &IdleCall::heard);
      this->Timer = interactor->CreateOneShotTimer(Wait);
    }
  }

  void cancel()
  {
    if (this->Interactor)
    {
      this->Interactor->DestroyTimer(this->Timer);
    }
    this->forget();
  }

private:
  static constexpr unsigned long Wait = 10; // ms, in which what users do comes first

  void heard(vtkObject*, unsigned long, void* timer)
  {
    if (timer && *static_cast<int*>(timer) == this->Timer && this->Call)
    {
      // The interactor is going through its timers, and takes this one out itself.
      const std::function<void()> call = std::move(this->Call);
      this->forget();
      call();
    }
  }

  void forget()
  {
    if (this->Interactor)
    {
      this->Interactor->RemoveObserver(this->Observer);
    }
    this->Interactor = nullptr;
    this->Call = nullptr;
  }

  vtkWeakPointer<vtkRenderWindowInteractor> Interactor;
  vtkWeakPointer<vtkRenderWindowInteractor> Tried;
  bool Knows = false;
  std::function<void()> Call;
  unsigned long Observer = 0;
  int Timer = 0;
};
}

#endif
