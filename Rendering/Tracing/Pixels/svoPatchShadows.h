// What the points of a patch miss of a light, those at the terminator included.
#ifndef svoPatchShadows_h
#define svoPatchShadows_h

#include "svoHits.h"
#include "svoLightShadow.h"
#include "svoScene.h"
#include "svoShadedTiles.h"
#include "svoSurfacePoint.h"
#include "svoTerminator.h"
#include "svoTileLighting.h"
#include "svoTilePatch.h"
#include "svoTileTriangles.h"

#include <cstdint>
#include <vector>

namespace svo
{
class PatchShadows
{
public:
  /// To be called once the eye has traced the scene.
  void prepare(const Scene& scene, const Hits& eye);

  /// Of an instance that is seen.
  const SurfaceMatrices& matrices(std::uint32_t instance) const { return this->Matrices[instance]; }

  /// What a thread needs to look at up to 64 points, and to ask for them.
  struct Scratch
  {
    TilePatch patch;
    TileTriangles triangles;
    TileLight light;
    double extents[TilePatch::Most];         // world: ShadowQuery::extents
    float missed[TilePatch::Most];           // by pixel: of one light
    std::vector<TerminatorPoint> terminator; // of one light
    std::uint64_t rays;                      // of shadows
    ShadedTiles::Tile* noted = nullptr;      // takes down what is asked; or null
  };

  /// Those of the patch that are `asked`. `sums`: of the query.
  ShadowQuery query(std::uint64_t asked, Scratch& scratch, SampleSums* sums = nullptr) const
  {
    return { scratch.patch, this->Errors[scratch.patch.instance], scratch.extents, asked,
      scratch.rays, sums };
  }

  /// Sets what those that are asked miss of a light, which reaches them; returns those that may
  /// miss something.
  std::uint64_t find(const LightShadow& shadow, const Light& light, const ShadowQuery& query,
    Scratch& scratch) const;

private:
  void findTerminator(const LightShadow& shadow, const Light& light, const ShadowQuery& query,
    std::uint64_t dark, Scratch& scratch) const;

  // By index into Scene::instances.
  std::vector<SurfaceMatrices> Matrices;
  std::vector<std::uint8_t> Smooth; // isSmooth()
  std::vector<PointErrors> Errors;  // of the instance's leaves as the eye sees them
};
}

#endif
