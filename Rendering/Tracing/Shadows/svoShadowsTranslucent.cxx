// What translucent casters take of a light.
#include "svoShadows.h"

#include <algorithm>

namespace svo
{
void Shadows::dim(std::size_t light, const TilePatch& patch, double error, const double* extents,
  std::uint64_t asked, float* missed, std::uint64_t& rays) const
{
  std::uint64_t left = 0;
  eachBit(asked, [&](int i) { left |= std::uint64_t(missed[i] < 1.0f) << i; });
  alignas(64) float taken[TilePatch::Most];
  const auto take = [&]
  {
    eachBit(left,
      [&](int i)
      {
        // Where nothing else is in the way it is what one caster takes, to the bit.
        missed[i] = missed[i] > 0.0f ? 1.0f - (1.0f - missed[i]) * (1.0f - taken[i]) : taken[i];
      });
  };
  if (this->usesRays(light))
  {
    rays += static_cast<std::uint64_t>(countBits(left));
    this->Rays->taken(this->Tested->lights[light], patch, error, left, taken);
    take();
    return;
  }
  for (std::size_t b = this->FirstTranslucent[light]; b < this->FirstTranslucent[light + 1]; ++b)
  {
    this->Buffers[b]->taken(patch, error, this->filters(light) ? extents : nullptr, left, taken);
    take();
  }
}
}
