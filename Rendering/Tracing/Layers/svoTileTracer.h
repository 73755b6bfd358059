// Traces the tiles of a view, a group at a time: finds the instances that its rays may meet,
// decides how each of them is traced, and merges what they hit. Private to a thread.
//
// What a ray of a tile meets of an instance is found by one of five methods. choose() says which,
// for a group; where triangles cannot be made ready, it is rays in the end.
//
//   Ball      a ball that stands for its triangles      GroupBalls
//   Layer     a kept depth layer; alone or by rays where it is not known
//   Together  the nearest triangles of all instances    GroupTriangles
//   Alone     the nearest of its own triangles          GroupTriangles
//   Rays      64 rays through its octree                svoTileRays.h
#ifndef svoTileTracer_h
#define svoTileTracer_h

#include "svoDepthBuffer.h"
#include "svoGroupBalls.h"
#include "svoGroupOcclusion.h"
#include "svoGroupTriangles.h"
#include "svoHitOrder.h"
#include "svoMergedTiles.h"
#include "svoTileGroup.h"
#include "svoTileRays.h"
#include "svoTracedInstances.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace svo
{
class TileTracer
{
public:
  /// `depth` and `tiles` are of the frame that begins; `lastHit` is DepthBuffer::hit of the last.
  /// Threads trace different groups of the same.
  TileTracer(const TracedInstances& instances, bool occlusion,
    const std::vector<std::uint8_t>& lastHit, DepthBuffer& depth, MergedTiles& tiles);

  /// Traces what is asked for of the group whose first tile this is. `nearby`: entries that reach
  /// into it, front to back.
  void trace(int groupX, int groupY, const std::uint32_t* nearby, std::size_t count);

  /// What became of an entry in all groups so far.
  struct Account
  {
    std::uint64_t rays = 0;
    bool asked = false;  // tiles were traced that it reaches into ...
    bool looked = false; // ... and it was not hidden there
    std::size_t counted; // the tile that has rays last
  };
  const Account& account(std::size_t entry) const { return this->Accounts[entry]; }

private:
  enum class Method : std::uint8_t
  {
    Ball,
    Layer,
    Together,
    Alone,
    Rays
  };
  /// An instance that the group's rays may meet, and that is no ball.
  struct Candidate
  {
    TilePart part; // of the tile at hand
    Method method = Method::Rays;
    Method unknown = Method::Rays; // of a layer's tiles that are not; Layer: nobody had to know
    bool hidden = false;           // others hide all that the group sees of it
    double key = 0.0;              // order of tracing
    GroupTriangles triangles;      // where it is traced alone
    const TracedInstance& entry() const { return *this->part.entry; }
  };

  /// Finds which tiles of the group are asked for; false if none.
  bool findWindow();
  void gather(const std::uint32_t* nearby, std::size_t count);
  Method choose(const TracedInstance& entry) const;
  /// Rays where its triangles cannot be made ready.
  Method aloneOrRays(Candidate& candidate);
  /// Adds what the group may see of those that are traced together. False, and all is to be done
  /// once more, if one of them turned out to have to be traced by rays.
  bool findTogether();
  void findHidden();

  /// Does no more than what changed since the last frame asks for, and notes whether it is seen.
  void mergeTile(int tileX, int tileY);
  /// `onlyChanged`: those instances are merged into what the tile was in the last frame.
  void traceTile(int tileX, int tileY, bool onlyChanged);
  /// Makes the candidates ready that are merged one by one, in the order in which that is done.
  void collect(int tileX, int tileY, bool onlyChanged, const MergedTile& merged);
  /// `deepest`: GroupOcclusion::deepest(), once somebody had to know.
  bool makeReady(int tileX, int tileY, const MergedTile& merged, std::optional<double>& deepest,
    Candidate& candidate);
  bool nearestTriangles(
    int tileX, int tileY, GroupTriangles& triangles, MergedTile& hits); // counts rays

  void mergeLayer(
    int tileX, int tileY, const TilePoints& at, Candidate& candidate, MergedTile& merged);
  /// Of a layer; false if the tile is empty.
  bool traceLayer(int tileX, int tileY, const TilePoints& at, Candidate& candidate, float* t,
    Primitive* primitive);
  void mergeAlone(
    int tileX, int tileY, const TilePoints& at, Candidate& candidate, MergedTile& merged);
  void mergeRays(const TilePoints& at, Candidate& candidate, MergedTile& merged);

  std::size_t indexOf(int tileX, int tileY) const { return this->Depth.grid.index(tileX, tileY); }
  Account& accountOf(const TracedInstance& entry)
  {
    return this->Accounts[this->Instances.indexOf(entry)];
  }
  /// Where so many instances are together they hide each other.
  bool manyTogether() const { return this->Together.size() >= 8; }

  const TracedInstances& Instances;
  const HitOrder Order;
  const std::vector<std::uint8_t>& LastHit;
  DepthBuffer& Depth;
  MergedTiles& Tiles;
  std::vector<Account> Accounts; // by entry
  TileGroup Group;
  GroupTriangles Triangles;          // of the candidates that are traced together
  GroupOcclusion Occlusion;          // by these
  std::vector<Candidate> Candidates; // at least those that reach into the group ...
  std::size_t Nearby = 0;            // ... which are so many, front to back
  std::vector<Candidate*> Together;  // of these, in the same order
  std::vector<Candidate*> OneByOne;  // of these, those that a tile's rays may meet
  GroupBalls Balls;                  // not among the candidates
  GroupTrianglesMemory Memory;
  struct
  {
    alignas(64) float t[64];
    alignas(64) std::uint32_t instance[64];
    alignas(64) Primitive primitive[64];
  } Own; // what one instance has in a tile
};
}

#endif
