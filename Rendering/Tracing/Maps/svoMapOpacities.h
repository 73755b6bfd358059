// How opaque a map's translucent casters are, texel by texel, where that is not the same all over
// them.
#ifndef svoMapOpacities_h
#define svoMapOpacities_h

#include "svoHits.h"
#include "svoPages.h"
#include "svoParallel.h"
#include "svoRawArray.h"
#include "svoScene.h"
#include "svoView.h"

#include <cstddef>
#include <cstdint>

namespace svo
{
class MapOpacities
{
public:
  /// After the map is traced, each time: of tiles that have changed, or of all. Of a
  /// texel it is that of the place on the caster that the ray of the texel's centre meets.
  void find(const Scene& scene, const View& view, const Hits& map, bool all,
    const ParallelFor& parallelFor);
  void forget()
  {
    this->Texels = {};
    this->Of = 0;
  }
  bool known() const { return this->Texels.size() > 0; }
  /// 0..1; `texel`: as DepthBuffer::at, of those that a caster lies at.
  float at(std::size_t texel) const { return this->Texels[texel]; }

private:
  RawArray<float, Pages<float>> Texels; // of tiles that something lies in
  std::uint64_t Of = 0;                 // Hits::version
};
}

#endif
