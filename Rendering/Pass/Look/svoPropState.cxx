#include "svoPropState.h"

#include "svoCompositeBlocks.h"
#include "svoKeepAlive.h"
#include "svoPropKeys.h"
#include "svoSplats.h"
#include "svoSurfaceLook.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkCamera.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeRange.h"
#include "vtkFollower.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkProperty.h"
#include "vtkSelection.h"
#include "vtkTexture.h"
#include "vtkTrivialProducer.h"

#include <algorithm>
#include <cstring>
#include <typeinfo>

namespace svo
{
namespace
{
using Numbers = std::vector<std::uint64_t>;

std::uint64_t numberOf(const void* object)
{
  return reinterpret_cast<std::uintptr_t>(object);
}

/// Of an actor and, if it is a follower, of the camera that it turns to.
std::uint64_t timeOfActor(vtkActor* actor, vtkFollower* follower)
{
  return std::max(timeOf(actor), follower ? timeOf(follower->GetCamera()) : 0);
}

/// All that is in a tree.
void addBlocks(vtkDataObject* data, Numbers& numbers)
{
  if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
  {
    for (vtkDataObject* child : vtk::Range(tree, vtk::DataObjectTreeOptions::None))
    {
      numbers.push_back(numberOf(child));
      numbers.push_back(timeOf(child));
      addBlocks(child, numbers);
    }
  }
}

Numbers texturesOf(vtkActor* actor)
{
  Numbers numbers;
  const auto add = [&](vtkTexture* texture)
  {
    if (texture)
    {
      numbers.push_back(numberOf(texture));
      numbers.push_back(timeOf(texture));
      numbers.push_back(timeOf(texture->GetInput()));
    }
  };
  add(actor->GetTexture());
  vtkProperty* property = actor->GetProperty();
  if (property->GetNumberOfTextures() > 0)
  {
    for (const auto& texture : property->GetAllTextures())
    {
      add(texture.second);
    }
  }
  return numbers;
}

bool hasTextures(vtkActor* actor)
{
  return actor->GetTexture() || actor->GetProperty()->GetNumberOfTextures() > 0;
}

/// Of what a mapper looks up and its own time does not tell of.
std::uint64_t timeOfParts(vtkMapper* mapper)
{
  return std::max<std::uint64_t>(timeOf(attributesOf(mapper)), timeOfSplats(mapper));
}

int selectedOf(vtkMapper* mapper)
{
  vtkSelection* selection = mapper->GetSelection();
  return selection ? static_cast<int>(selection->GetNumberOfNodes()) : 0;
}

void update(vtkAlgorithm* algorithm, int port, vtkAlgorithm*& updated)
{
  if (algorithm != updated)
  {
    algorithm->Update(port);
    updated = algorithm;
  }
}
}

vtkSmartPointer<vtkMatrix4x4> matrixOfPart(vtkProp* part, vtkMatrix4x4* ofPath)
{
  auto* follower = vtkFollower::SafeDownCast(part);
  if (!follower || !follower->GetCamera())
  {
    return ofPath;
  }
  auto turned = vtkSmartPointer<vtkMatrix4x4>::New();
  follower->PokeMatrix(ofPath);
  follower->GetMatrix(turned);
  follower->PokeMatrix(nullptr);
  return turned;
}

/// What an actor has of its own that is no matrix.
Numbers PropState::lookOf(vtkActor* actor)
{
  return { numberOf(actor->GetProperty()), timeOf(actor->GetProperty()),
    numberOf(actor->GetBackfaceProperty()), timeOf(actor->GetBackfaceProperty()),
    static_cast<std::uint64_t>(actor->GetForceOpaque()),
    static_cast<std::uint64_t>(actor->GetForceTranslucent()) };
}

bool PropState::noteActor(vtkActor* actor, vtkProp* owner, Actor& state)
{
  state.keys = actor->GetPropertyKeys();
  state.follower = vtkFollower::SafeDownCast(actor);
  state.time = timeOfActor(actor, state.follower);
  state.timeOfKeys = timeOf(actor->GetPropertyKeys());
  state.answers = answersOf(actor);
  vtkMapper* mapper = state.mapper = actor->GetMapper();
  // Who says that an actor of another class uses octrees knows what it draws.
  const bool known = isPlainActor(actor) || flagOf(actor, owner, useSVOKey(), false);
  if (!known || (mapper && !isPlainMapper(mapper)))
  {
    return false;
  }
  state.look = lookOf(actor);
  state.textures = texturesOf(actor);
  state.customShaders = hasCustomShaders(actor);
  if (!mapper)
  {
    return true;
  }
  for (int port = 0; port < mapper->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < mapper->GetNumberOfInputConnections(port); ++i)
    {
      vtkAlgorithmOutput* connection = mapper->GetInputConnection(port, i);
      Input input{};
      input.producer = connection->GetProducer();
      input.port = connection->GetIndex();
      const vtkAlgorithm& producer = *input.producer;
      input.handsOn = typeid(producer) == typeid(vtkTrivialProducer);
      input.data = input.producer->GetOutputDataObject(input.port);
      input.time = input.handsOn ? timeOf(input.producer) : timeOf(input.data);
      addBlocks(input.data, input.blocks);
      state.inputs.push_back(input);
    }
  }
  state.timeOfMapper = mapper->GetMTime();
  state.timeOfParts = timeOfParts(mapper);
  state.selected = selectedOf(mapper);
  state.depthOffset = coincidentOffset(mapper);
  return true;
}

bool PropState::holds(const Input& input, bool isStatic, vtkAlgorithm*& updated)
{
  if (input.handsOn)
  {
    if (timeOf(input.producer) != input.time)
    {
      return false;
    }
  }
  else
  {
    if (!isStatic)
    {
      update(input.producer, input.port, updated);
    }
    if (input.producer->GetOutputDataObject(input.port) != input.data ||
      timeOf(input.data) != input.time)
    {
      return false;
    }
  }
  if (input.blocks.empty())
  {
    return true;
  }
  Numbers blocks;
  blocks.reserve(input.blocks.size());
  addBlocks(input.data, blocks);
  return blocks == input.blocks;
}

Held PropState::holds(vtkActor* actor, const Actor& state, vtkAlgorithm*& updated)
{
  vtkInformation* keys = actor->GetPropertyKeys();
  const bool sameTime = timeOfActor(actor, state.follower) == state.time;
  const bool sameKeys = keys == state.keys && timeOf(keys) == state.timeOfKeys;
  if ((!sameTime && lookOf(actor) != state.look) ||
    (!sameKeys && answersOf(actor) != state.answers) ||
    hasTextures(actor) == state.textures.empty() ||
    (!state.textures.empty() && texturesOf(actor) != state.textures) ||
    hasCustomShaders(actor) != state.customShaders || actor->GetMapper() != state.mapper)
  {
    return Held::No;
  }
  const Held held = sameTime ? Held::Yes : Held::Moved;
  vtkMapper* mapper = state.mapper;
  if (!mapper)
  {
    return held;
  }
  if (mapper->GetMTime() != state.timeOfMapper || selectedOf(mapper) != state.selected ||
    coincidentOffset(mapper) != state.depthOffset ||
    (state.timeOfParts != 0 && timeOfParts(mapper) != state.timeOfParts))
  {
    return Held::No;
  }
  const bool isStatic = mapper->GetStatic() != 0;
  for (const Input& input : state.inputs)
  {
    if (!holds(input, isStatic, updated))
    {
      return Held::No;
    }
  }
  // Who was told of an update may have changed what had been looked at.
  const bool quiet = state.inputs.empty() || state.inputs.front().handsOn ||
    mapper->GetMTime() == state.timeOfMapper;
  return quiet ? held : Held::No;
}

/// The leaves of an assembly that are seen, and where they are. Its own time, and theirs, say
/// nothing: VTK modifies the leaves when it draws them.
void PropState::noteParts(vtkProp* assembly, Numbers& numbers, std::vector<vtkActor*>& actors)
{
  const auto [flags, error] = answersOf(assembly);
  std::uint64_t bits;
  std::memcpy(&bits, &error, sizeof(bits));
  numbers.push_back(flags);
  numbers.push_back(bits);
  assembly->InitPathTraversal();
  while (vtkAssemblyPath* path = assembly->GetNextPath())
  {
    vtkAssemblyNode* node = path->GetLastNode();
    vtkProp* leaf = node->GetViewProp();
    numbers.push_back(numberOf(leaf));
    numbers.push_back(leaf->GetVisibility() != 0);
    if (!leaf->GetVisibility())
    {
      continue;
    }
    if (const auto matrix = matrixOfPart(leaf, node->GetMatrix()))
    {
      std::uint64_t elements[16];
      static_assert(sizeof(elements) == sizeof(matrix->Element), "as they are");
      std::memcpy(elements, matrix->Element, sizeof(elements));
      numbers.insert(numbers.end(), elements, elements + 16);
    }
    if (auto* actor = vtkActor::SafeDownCast(leaf))
    {
      actors.push_back(actor);
    }
  }
}

void PropState::note(vtkProp* prop)
{
  *this = PropState();
  auto* actor = vtkActor::SafeDownCast(prop);
  this->IsActor = actor != nullptr;
  std::vector<vtkActor*> actors{ actor };
  if (!actor)
  {
    actors.clear();
    noteParts(prop, this->Parts, actors);
  }
  this->Known = true;
  this->Actors.resize(actors.size());
  for (std::size_t i = 0; i < actors.size(); ++i)
  {
    this->Known = noteActor(actors[i], prop, this->Actors[i]) && this->Known;
  }
}

void PropState::noteMove(vtkProp* actor)
{
  Actor& state = this->Actors.front();
  state.time = timeOfActor(static_cast<vtkActor*>(actor), state.follower);
}

Held PropState::holds(vtkProp* prop, vtkAlgorithm*& updated) const
{
  if (!this->Known)
  {
    return Held::No;
  }
  if (this->IsActor)
  {
    return holds(static_cast<vtkActor*>(prop), this->Actors.front(), updated);
  }
  Numbers parts;
  std::vector<vtkActor*> actors;
  noteParts(prop, parts, actors);
  bool same = parts == this->Parts && actors.size() == this->Actors.size();
  for (std::size_t i = 0; same && i < actors.size(); ++i)
  {
    same = holds(actors[i], this->Actors[i], updated) != Held::No;
  }
  return same ? Held::Yes : Held::No;
}
}
