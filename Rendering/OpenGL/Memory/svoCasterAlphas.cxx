#include "svoCasterAlphas.h"

#include "svoSurface.h"
#include "svoSurfaceAlpha.h"

namespace svo
{
namespace
{
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

void append(const Instance& caster, const glm::vec2& first, std::vector<float>& numbers)
{
  const int texels = texelsOf(caster);
  numbers.insert(numbers.end(),
    { caster.opacity, static_cast<float>(numbersOfEach(caster)), first.x, first.y,
      static_cast<float>(texels), 0.0f, 0.0f, 0.0f });
  for (int i = 0; i < 2 * texels; ++i)
  {
    numbers.push_back(detail::alphaAt(caster.body->attributes.colorTexture, i));
  }
  const SurfaceMatrices matrices(caster);
  const Surface* surface = caster.body->octree.surface();
  for (std::uint32_t i = 0; i < countOf(caster.body->octree); ++i)
  {
    if (!surface)
    {
      numbers.push_back(detail::alphaOfPlane(matrices, i, glm::dvec3(0.0)));
      continue;
    }
    const TriangleLook look(matrices, i);
    for (int axis = 0; axis < (texels > 0 ? 2 : 1); ++axis)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        const glm::vec3 weight(corner == 0, corner == 1, corner == 2);
        numbers.push_back(texels > 0 ? look.coordinates[corner][axis]
                                     : detail::alphaOfTriangle(look, *surface, i, weight));
      }
    }
  }
  numbers.resize((numbers.size() + 7) / 8 * 8, 0.0f);
}
}

void CasterAlphas::clear()
{
  this->Casters.clear();
  this->Keys.clear();
  this->Size = 0;
}

std::size_t CasterAlphas::add(const Instance& caster, const glm::vec2& first)
{
  const Octree& octree = caster.body->octree;
  const Attributes& attributes = caster.body->attributes;
  const std::size_t begin = this->Size;
  const std::size_t count = 8 + 2 * texelsOf(caster) + numbersOfEach(caster) * countOf(octree);
  this->Casters.push_back({ &caster, first });
  this->Keys.emplace_back(octree.id(), attributes.version, attributes.colors,
    attributes.colorCoordinates, attributes.colorTexture, caster.opacity, first.x, first.y);
  this->Size += (count + 7) / 8 * 8;
  return begin / 8;
}

bool CasterAlphas::send()
{
  if (this->Keys == this->Sent)
  {
    return true;
  }
  this->release();
  if (this->Size > BufferTexture::most() || (this->Size > 0 && !this->Texels.allocate(this->Size)))
  {
    return false;
  }
  std::vector<float> numbers;
  numbers.reserve(this->Size);
  for (const Caster& caster : this->Casters)
  {
    append(*caster.instance, caster.first, numbers);
  }
  this->Texels.send(0, numbers.data(), numbers.size());
  this->Sent = this->Keys;
  return true;
}

void CasterAlphas::release()
{
  this->Texels.release();
  this->Sent.clear();
}
}
