// Points against a shadow buffer, one by one and by tiles.
#include "svoShadowBuffer.h"

#include "svoShadowTest.h"
#include "svoTexelPlace.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace svo
{
bool ShadowBuffer::shadows(const SurfacePoint& point, double error) const
{
  Place place;
  return this->lookUp(point.position, place) && this->shadows(place, point, error);
}

bool ShadowBuffer::shadows(const Place& place, const SurfacePoint& point, double error) const
{
  const Answer answer = this->ask(place, place.nearest(), point, error);
  if (answer != Answer::DarkNearby)
  {
    return answer == Answer::Dark;
  }
  return this->agreed(place, point, error);
}

void ShadowBuffer::shadows(const TilePoints& points, int first, int last, double error,
  const std::uint8_t* asked, std::uint8_t* dark) const
{
  assert(first >= 0 && first < last && last <= points.count);
  const int count = last - first;
  if (this->Faces.size() != 1 || !this->AutomaticBias)
  {
    for (int i = 0; i < count; ++i)
    {
      dark[i] = asked[i] && this->shadows(points.point(first + i), error);
    }
    return;
  }
  std::fill_n(dark, count, std::uint8_t(0));
  const Face& face = *this->Faces.front();
  if (!face.seesCasters)
  {
    return;
  }
  TexelPlaces places;
  lookUpTexels(face.view, face.worldToClip, points, first, last, places);
  TexelTests tests;
  const DepthBuffer& depth = face.layers.depthBuffer();
  const double infinity = std::numeric_limits<double>::infinity();
  bool any = false;
  for (int i = 0; i < count + TilePoints::Step; ++i)
  {
    tests.x[i] = tests.y[i] = tests.bias[i] = tests.error[i] = 0.0;
    tests.occluder[i] = infinity;
    if (i >= count || !asked[i] || !(places.inside[i] > 0.0))
    {
      continue;
    }
    const int x = static_cast<int>(places.x[i]), y = static_cast<int>(places.y[i]);
    std::uint32_t caster;
    if (!face.occluder(depth.at(x, y), caster, tests.occluder[i]))
    {
      continue;
    }
    any = true;
    tests.x[i] = x + 0.5;
    tests.y[i] = y + 0.5;
    tests.bias[i] = this->Bias * this->CasterVoxel[caster];
    tests.error[i] = std::max(this->CasterError[caster], error);
  }
  if (!any)
  {
    return;
  }
  testTexels(face.view, face.edge, points, first, last, places, tests);
  for (int i = 0; i < count; ++i)
  {
    dark[i] = tests.dark[i] > 0.0;
    if (tests.dark[i] == 1.0)
    {
      const Place place{ &face, places.x[i], places.y[i], places.t[i] };
      dark[i] = this->agreed(place, points.point(first + i), error);
    }
  }
}

bool ShadowBuffer::agreed(const Place& place, const SurfacePoint& point, double error) const
{
  int dark = 0;
  for (int i = 1; i < 4; ++i)
  {
    dark += this->ask(place, place.neighbour(i), point, error) != Answer::Lit;
  }
  return dark >= TexelsToAgree;
}

ShadowBuffer::Answer ShadowBuffer::ask(const Place& place, const glm::ivec2& texel,
  const SurfacePoint& point, double error, double span) const
{
  const Face* face = place.face;
  assert(face && span >= 1.0);
  const double t = place.t;
  if (texel.x < 0 || texel.y < 0 || texel.x >= face->view.width || texel.y >= face->view.height)
  {
    return Answer::Lit;
  }
  std::uint32_t caster;
  double occluder;
  if (!face->occluder(face->layers.depthBuffer().at(texel.x, texel.y), caster, occluder))
  {
    return Answer::Lit;
  }
  const double bias = this->Bias * this->CasterVoxel[caster];
  if (!this->AutomaticBias)
  {
    return occluder + bias < t ? Answer::Dark : Answer::Lit;
  }
  if (!mayShadow(t, span * face->edge(t), occluder, bias))
  {
    return Answer::Lit;
  }
  const double answer = shadowTest(face->view, face->edge,
    { point.position, glm::dvec3(point.facet), glm::dvec3(point.normal), t, texel.x + 0.5,
      texel.y + 0.5, span, occluder, bias, std::max(this->CasterError[caster], error) });
  return static_cast<Answer>(static_cast<int>(answer));
}

double ShadowBuffer::texelEdge(const glm::dvec3& position) const
{
  Place place;
  return this->lookUp(position, place) ? place.face->edge(place.t) : 0.0;
}
}
