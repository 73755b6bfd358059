#include "svoCasterAlphas.h"

#include "svoSurface.h"
#include "svoSurfaceAlpha.h"

namespace svo
{
namespace
{
constexpr std::uint32_t Split = 4096; // floats tell no larger numbers apart

int texelsOf(const Instance& caster)
{
  const Attributes& attributes = caster.body->attributes;
  return caster.body->octree.surface() && attributes.colorCoordinates ? attributes.colorTextureSize
                                                                      : 0;
}

int numbersOfEach(const Instance& caster)
{
  return !caster.body->octree.surface() ? 1 : texelsOf(caster) > 0 ? 6 : 3;
}

std::size_t countOf(const Octree& octree)
{
  return octree.surface() ? octree.surface()->triangles.size() : octree.header().listWords;
}

void append(const Instance& caster, std::uint32_t first, std::vector<float>& numbers)
{
  const int texels = texelsOf(caster);
  numbers.insert(numbers.end(),
    { caster.opacity, static_cast<float>(numbersOfEach(caster)), static_cast<float>(first / Split),
      static_cast<float>(first % Split), static_cast<float>(texels), 0.0f, 0.0f, 0.0f });
  for (int i = 0; i < 2 * texels; ++i)
  {
    numbers.push_back(detail::alphaAt(caster.body->attributes.colorTexture, i));
  }
  const SurfaceMatrices frame(caster);
  const Surface* surface = caster.body->octree.surface();
  for (std::uint32_t i = 0; i < countOf(caster.body->octree); ++i)
  {
    if (!surface)
    {
      numbers.push_back(detail::alphaOfPlane(frame, i, glm::dvec3(0.0)));
    }
    else if (texels > 0)
    {
      const TriangleLook look(frame, i);
      for (int axis = 0; axis < 2; ++axis)
      {
        for (const glm::vec2& place : look.coordinates)
        {
          numbers.push_back(place[axis]);
        }
      }
    }
    else
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        numbers.push_back(detail::alphaOfTriangle(
          frame, i, glm::dvec3(surface->points[surface->triangles[i][corner]])));
      }
    }
  }
}
}

bool CasterAlphas::Caster::operator==(const Caster& other) const
{
  return this->first == other.first && this->end == other.end && this->octree == other.octree &&
    this->version == other.version && this->colors == other.colors &&
    this->opacity == other.opacity;
}

std::size_t CasterAlphas::add(const Instance& caster, std::uint32_t first)
{
  const Octree& octree = caster.body->octree;
  const Attributes& attributes = caster.body->attributes;
  const std::size_t begin = this->Casters.empty() ? 0 : this->Casters.back().end;
  const std::size_t count = 8 + 2 * texelsOf(caster) + numbersOfEach(caster) * countOf(octree);
  this->Casters.push_back(
    { &caster, first, begin + (count + 7) / 8 * 8, octree.id(), attributes.version,
      texelsOf(caster) > 0 ? attributes.colorTexture : attributes.colors, caster.opacity });
  return begin / 8;
}

bool CasterAlphas::send()
{
  if (this->Casters == this->Sent)
  {
    return true;
  }
  this->release();
  const std::size_t size = this->Casters.empty() ? 0 : this->Casters.back().end;
  if (size > BufferTexture::most() || (size > 0 && !this->Texels.allocate(size)))
  {
    return false;
  }
  std::vector<float> numbers;
  numbers.reserve(size);
  for (const Caster& caster : this->Casters)
  {
    append(*caster.instance, caster.first, numbers);
    numbers.resize(caster.end, 0.0f);
  }
  this->Texels.send(0, numbers.data(), numbers.size());
  this->Sent = this->Casters;
  return true;
}

void CasterAlphas::release()
{
  this->Texels.release();
  this->Sent.clear();
}
}
