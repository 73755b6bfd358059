#include "svoLooseOctree.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <glm/common.hpp>

namespace svo
{
namespace
{
std::int32_t bitsOf(float x)
{
  std::int32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

/// The smallest float that is not below x, which is not negative; beyond 1e30 that.
float floatAbove(double x)
{
  x = std::min(x, 1e30);
  float f = static_cast<float>(x);
  if (f < x)
  {
    const std::int32_t bits = bitsOf(f) + 1;
    std::memcpy(&f, &bits, sizeof f);
  }
  return f;
}
}

LooseOctree::LooseOctree(const glm::dvec3& centre, double edge)
  : Low(centre - 0.5 * edge)
  , PerUnit(Units / edge)
  , Unit(edge / Units)
  , Nodes(8)
  , Chunks(1)
{
  // Products and sums of numbers of this size, a few roundings each.
  const glm::dvec3 size = glm::abs(this->Low) + edge;
  this->Noise = 0x1p-50 * std::max({ size.x, size.y, size.z });
  const bool valid =
    std::isfinite(this->Noise) && std::isfinite(this->PerUnit) && edge > 0.0 && this->Unit > 0.0;
  if (!valid)
  {
    this->Low = glm::dvec3(std::numeric_limits<double>::quiet_NaN()); // nothing lies there
  }
}

LooseOctree::Spot LooseOctree::spotOf(const glm::dvec3& centre, double radius) const
{
  const glm::dvec3 at = (centre - this->Low) * this->PerUnit;
  Spot spot;
  // False for what is not a number.
  if (!(at.x >= 0.0 && at.x <= Units && at.y >= 0.0 && at.y <= Units && at.z >= 0.0 &&
        at.z <= Units && radius >= 0.0))
  {
    return spot;
  }
  const float units = floatAbove(radius * this->PerUnit);
  spot.radius = units <= Reach ? units : -1.0f;
  // The upper sides of the cube belong to it.
  const auto unit = [](double x)
  { return static_cast<std::uint32_t>(std::min(x, static_cast<double>(0xffffffffu))); };
  spot.x = unit(at.x);
  spot.y = unit(at.y);
  spot.z = unit(at.z);
  return spot;
}

int LooseOctree::depthOf(float radius) const
{
  // Floats above 0 are ordered as their bits; a step of 2^23 is a power of two. So this is the
  // largest d with radius <= reach / 2^d, without a rounding.
  const std::int32_t d = (bitsOf(Reach) - bitsOf(radius)) >> 23;
  assert(d >= 0);
  return std::min(d, MostDepth);
}

void LooseOctree::insert(std::uint32_t object, const glm::dvec3& centre, double radius)
{
  assert(object < Outside);
  if (object >= this->Records.size())
  {
    this->Records.resize(object + std::size_t{ 1 });
  }
  else if (this->move(object, centre, radius))
  {
    return;
  }
  this->put(object, this->spotOf(centre, radius));
}

void LooseOctree::put(std::uint32_t object, const Spot& spot)
{
  Record& record = this->Records[object];
  static_cast<Spot&>(record) = spot;
  if (!spot.inside())
  {
    record.node = Outside;
    record.place = static_cast<std::uint32_t>(this->Outsiders.size());
    this->Outsiders.push_back(object);
    return;
  }
  this->enter(0, object);
}

bool LooseOctree::move(std::uint32_t object, const glm::dvec3& centre, double radius)
{
  if (!this->contains(object))
  {
    return false;
  }
  const Spot spot = this->spotOf(centre, radius);
  Record& record = this->Records[object];
  if (!spot.inside() || record.node == Outside)
  {
    if (spot.inside() || record.node != Outside)
    {
      this->remove(object);
      this->put(object, spot);
    }
    return true;
  }
  const std::uint32_t changed = (record.x ^ spot.x) | (record.y ^ spot.y) | (record.z ^ spot.z);
  const int deepest = this->depthOf(spot.radius);
  const bool sameDepth = deepest == this->depthOf(record.radius);
  static_cast<Spot&>(record) = spot;
  if (sameDepth && static_cast<std::uint64_t>(changed) >> (32 - record.depth) == 0)
  {
    this->writeBall(record);
    return true;
  }
  // Up to the deepest node that both places have above them: it keeps as many as before.
  const int depth = record.depth;
  const int same = changed == 0 ? 32 : __builtin_clz(changed); // leading bits
  const int shared = std::min({ depth, deepest, same });
  const std::uint32_t from = record.node;
  std::uint32_t above = from;
  for (int d = depth; d > shared; --d)
  {
    above = this->Nodes[above].parent;
  }
  this->takeOut(object);
  this->leave(from, above);
  if (deepest == shared || this->Nodes[above].total <= Bucket)
  {
    this->append(above, object);
  }
  else
  {
    this->enter(this->childFor(above, record), object);
  }
  return true;
}

bool LooseOctree::remove(std::uint32_t object)
{
  if (!this->contains(object))
  {
    return false;
  }
  Record& record = this->Records[object];
  if (record.node == Outside)
  {
    const std::uint32_t last = this->Outsiders.back();
    this->Outsiders[record.place] = last;
    this->Records[last].place = record.place;
    this->Outsiders.pop_back();
  }
  else
  {
    const std::uint32_t from = record.node;
    this->takeOut(object);
    this->leave(from, Absent);
  }
  record.node = Absent;
  return true;
}

std::size_t LooseOctree::memory() const
{
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof v[0]; };
  return sizeof *this + bytes(this->Records) + bytes(this->Nodes) + bytes(this->Chunks) +
    bytes(this->Outsiders) + bytes(this->FreeGroups) + bytes(this->FreeChunks);
}
}
