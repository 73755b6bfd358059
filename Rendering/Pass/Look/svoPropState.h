// All that the collected surfaces of a prop depend on: as long as it holds, they are what they
// were.
#ifndef svoPropState_h
#define svoPropState_h

#include "svoDepthOffset.h"
#include "svoPropKeys.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <vector>

class vtkActor;
class vtkAlgorithm;
class vtkDataObject;
class vtkFollower;
class vtkMapper;
class vtkMatrix4x4;
class vtkProp;

namespace svo
{
/// The matrix by which VTK draws a part of an assembly: that of its path in the place of its own,
/// with which a follower turns to its camera all the same.
vtkSmartPointer<vtkMatrix4x4> matrixOfPart(vtkProp* part, vtkMatrix4x4* ofPath);

enum class Held
{
  No,
  Moved, // an actor that is elsewhere, unchanged otherwise
  Yes
};

/// The addresses and times of an actor with its property, keys and textures, of the camera that it
/// follows, of its mapper with lookup table, functions and attributes of blocks, of that one's
/// inputs and sources, and the matrices of an assembly. Times are never given twice, so another
/// object in an old one's place is noticed, too. What is changed in place without Modified() does
/// not show, as in VTK's own mappers.
class PropState
{
public:
  /// Notes a prop that was looked at just now: its pipelines are up to date.
  void note(vtkProp* prop);

  /// Whether the prop is unchanged since it was noted. No if that cannot be told, as of classes
  /// that may draw anything. Brings its pipelines up to date; `updated` is the algorithm that this
  /// was last done of in this frame.
  Held holds(vtkProp* prop, vtkAlgorithm*& updated) const;

  /// Notes that an actor has moved.
  void noteMove(vtkProp* actor);

private:
  /// What a mapper reads.
  struct Input
  {
    vtkAlgorithm* producer; // as long as the mapper was not modified
    int port;
    bool handsOn; // what it was given; its time is that of the data, too
    vtkDataObject* data;
    std::uint64_t time;
    std::vector<std::uint64_t> blocks; // times of what is in a tree
  };
  struct Actor
  {
    const void* keys = nullptr;
    vtkFollower* follower = nullptr; // the actor, if it is one
    std::uint64_t time = 0, timeOfKeys = 0;
    PropAnswers answers;
    std::vector<std::uint64_t> look; // all of it but place and visibility
    std::vector<std::uint64_t> textures;
    bool customShaders = false;
    vtkMapper* mapper = nullptr;
    std::uint64_t timeOfMapper = 0, timeOfParts = 0;
    int selected = 0;
    DepthOffset depthOffset;
    std::vector<Input> inputs;
  };
  static bool noteActor(vtkActor* actor, vtkProp* owner, Actor& state);
  static std::vector<std::uint64_t> lookOf(vtkActor* actor);
  static Held holds(vtkActor* actor, const Actor& state, vtkAlgorithm*& updated);
  static bool holds(const Input& input, bool isStatic, vtkAlgorithm*& updated);
  static void noteParts(
    vtkProp* assembly, std::vector<std::uint64_t>& numbers, std::vector<vtkActor*>& actors);

  bool Known = false;
  bool IsActor = false;
  std::vector<std::uint64_t> Parts; // of an assembly
  std::vector<Actor> Actors;
};
}

#endif
