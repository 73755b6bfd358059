#include "svoPassFrame.h"

#include "svoSampleStep.h"
#include "svoSceneLights.h"

#include "vtkCommand.h"
#include "vtkLightCollection.h"
#include "vtkRenderWindow.h"

#include <algorithm>
#include <limits>

namespace svo
{
namespace
{
/// From this rate on VTK asks for interaction rather than for a picture to keep.
constexpr double InteractiveRate = 1.0; // Hz

/// Share of an interactive frame's time that is the pass's; the rest is for what else is drawn.
constexpr double OwnShare = 0.5;

/// Of lights with a size, a pixel of an interactive frame, and of the first one of a picture that
/// is refined. What is all around changes slowly: filtered, one sample tells nearly as much.
constexpr int FirstSamples = 4, FirstSamplesAround = 1;
}

bool PassFrame::interactive() const
{
  return this->renderer->GetRenderWindow()->GetDesiredUpdateRate() >= InteractiveRate;
}

std::function<bool()> PassFrame::abort(bool ask, bool heard, bool& disturbed) const
{
  vtkSmartPointer<vtkRenderWindow> window = this->renderer->GetRenderWindow();
  const bool observed = ask && window->HasObserver(vtkCommand::AbortCheckEvent);
  if (!observed && !heard)
  {
    return nullptr; // there is nobody who could say so
  }
  return [window, observed, &disturbed]
  {
    if (observed && !window->GetAbortRender())
    {
      disturbed = true;
      window->CheckAbortStatus();
    }
    return window->GetAbortRender() != 0;
  };
}

void PassFrame::tellOnce(const std::string& text, std::set<std::string>& said)
{
  if (!text.empty() && said.insert(text).second)
  {
    this->messages.push_back(text);
  }
}

void PassFrame::tellOfShadows(const ShadowWords& words, std::set<std::string>& said)
{
  const CollectedScene& collected = this->state->collected();
  if (collected.lights.headlightOnly)
  {
    this->tellOnce(words.onlyHeadlights, said);
  }
  const auto miss = [&](const std::string& start, const std::string& why)
  {
    // What has been said of this frame was why.
    if (!start.empty() && !why.empty() && said.insert(why).second && this->messages.empty())
    {
      const int objects = collected.withoutShadows;
      this->messages.push_back(start +
        (objects == 1 ? "The only object " : "Each of " + std::to_string(objects) + " objects ") +
        why + ".");
    }
  };
  miss(words.nothingCasts, collected.nothingCasts);
  miss(words.nothingReceives, collected.nothingReceives);
  if (collected.clippedCastNone && collected.nothingCasts.empty())
  {
    this->tellOnce(words.clipped, said);
  }
  if (collected.lights.aimless)
  {
    this->tellOnce(
      "A light has no direction, so it lights nothing and casts no shadow: its position is its "
      "focal point, or one of them is not finite.",
      said);
  }
}

/// How many samples of lights it takes, and whether it goes on at once.
void PassFrame::decideSamples(const PaceLimits& limits)
{
  const bool straight = !this->interactive() && !limits.refinesLater;
  const int shown = this->state->samples();
  const bool slow = this->settings.filterLightSamples && !hasSoftLight(this->renderer) &&
    !this->settings.skyPicture; // which may have a sun
  const int first = slow ? FirstSamplesAround : FirstSamples;
  const bool more = limits.refine > 0.0 && !this->interactive() && shown > 0;
  // What twice as many have changed is the error.
  const double each = limits.lightError > 0.0 ? 0.0 : this->state->secondsOfSample();
  this->settings.samplesNow = more         ? shown + moreSamples(shown, each, limits.refine)
    : straight && limits.lightError <= 0.0 ? std::numeric_limits<int>::max()
                                           : first;
  this->lightError = limits.lightError;
  this->refinesAtOnce = straight && limits.refine <= 0.0;
}

void PassFrame::decide(const FrameSettings& asked, const PaceLimits& limits)
{
  this->settings = asked;
  PassStatistics& statistics = this->state->statistics();
  statistics.pacedShadows = hasCameraLight(this->renderer);
  this->decideSamples(limits);
  if (!this->interactive())
  {
    return;
  }
  if (limits.adjust)
  {
    this->pace =
      this->state->choosePace(OwnShare / this->renderer->GetRenderWindow()->GetDesiredUpdateRate(),
        std::max(limits.maximum / statistics.imageReduction, 1.0));
    this->pace.coarseness = statistics.pacedShadows ? this->pace.coarseness : 1.0;
    this->settings.shadowCoarseness = this->pace.coarseness;
  }
  const double distance = this->pace.distance * statistics.imageReduction;
  this->settings.detailThreshold = limits.detail / (distance * distance);
}

void PassFrame::lightNothing()
{
  this->lightNothingMore();
  this->blackLight = vtkSmartPointer<vtkLight>::New();
  this->blackLight->SetLightTypeToHeadlight();
  this->blackLight->SetIntensity(0.0);
  this->renderer->GetLights()->AddItem(this->blackLight);
}

void PassFrame::lightNothingMore()
{
  if (this->blackLight)
  {
    this->renderer->GetLights()->RemoveItem(this->blackLight);
    this->blackLight = nullptr;
  }
}

void PassFrame::trace(int width, int height)
{
  this->traced = true;
  this->state->trace(
    width, height, this->pace, this->settings, this->lightError, this->refinesAtOnce);
  this->state->receivers().activate();
}
}
