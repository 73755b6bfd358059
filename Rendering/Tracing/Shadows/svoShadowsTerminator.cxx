// What Shadows knows of points at the terminator.
#include "svoShadows.h"

#include <algorithm>
#include <cassert>

#include <glm/geometric.hpp>

namespace svo
{
void Shadows::note(std::size_t light, const TerminatorPoint& at, RaisedTiles& noted) const
{
  if (this->Buffers[light] && !this->usesRays(light))
  {
    this->Buffers[light]->note(at.point.position, static_cast<std::uint16_t>(light), noted);
  }
}

bool Shadows::changed(const RaisedTiles& noted) const
{
  return std::any_of(noted.begin(), noted.end(),
    [this](const RaisedTile& raised)
    {
      const ShadowBuffer& buffer = *this->Buffers[raised.tile.light];
      return buffer.wants(raised.tile) != raised.wanted ||
        (raised.wanted && buffer.changed(raised.tile));
    });
}

void Shadows::darkness(std::size_t light, const TilePatch& patch,
  const std::vector<TerminatorPoint>& points, double error, const double* extents, float* missed,
  std::uint64_t& rays) const
{
  assert(light < this->Buffers.size() && points.size() <= ShadowRays::Most);
  const ShadowBuffer* buffer = this->usesRays(light) ? nullptr : this->Buffers[light];
  const Light& source = this->Tested->lights[light];
  const SurfacePoint* asked[ShadowRays::Most] = {}; // by rays to the light, after all else
  float* answers[ShadowRays::Most];
  float ifLit[ShadowRays::Most];
  int count = 0;
  for (const TerminatorPoint& at : points)
  {
    float& answer = missed[at.pixel];
    if (at.kind == TerminatorPoint::Kind::Hidden)
    {
      answer = 1.0f;
      continue;
    }
    assert(at.kind != TerminatorPoint::Kind::Plain && this->Rays);
    // A map says that a point is dark for less than it takes rays to say that ways are free.
    const double* extent = this->filters(light) ? extents + at.pixel : nullptr;
    const ShadowBuffer::MapAnswer inMap =
      buffer ? buffer->ask(at.point, error, extent) : ShadowBuffer::MapAnswer();
    const bool doubted = at.kind == TerminatorPoint::Kind::Doubted;
    if (!doubted)
    {
      answer = 1.0f; // unless all is free
    }
    if (inMap.darkness >= answer)
    {
      continue;
    }
    const glm::dvec3 on = patch.position(at.pixel);
    if (doubted || glm::distance(on, at.point.position) > inMap.texel)
    {
      ++rays;
      const glm::dvec3 start = ShadowRays::start(source, at.point.position, at.point.facet, error);
      if (this->Rays->between(on, start, error))
      {
        continue;
      }
    }
    if (!doubted && inMap.known)
    {
      answer = inMap.darkness;
      continue;
    }
    rays += !doubted;
    asked[count] = &at.point;
    answers[count] = &answer;
    ifLit[count++] = inMap.darkness;
  }
  const std::uint64_t dark = this->Rays ? this->Rays->shadows(source, asked, count, error) : 0;
  for (int i = 0; i < count; ++i)
  {
    *answers[i] = dark >> i & 1 ? *answers[i] : ifLit[i];
  }
}
}
