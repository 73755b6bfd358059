#include "svoMeshSignature.h"

#include "svoCellIds.h"
#include "svoSMPParallel.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include <hwy/base.h>

namespace svo
{
namespace
{
/// The 128-bit product of both, folded, as wyhash (Wang Yi) mixes.
std::uint64_t mix(std::uint64_t a, std::uint64_t b)
{
  std::uint64_t high;
  const std::uint64_t low =
    hwy::Mul128(a ^ 0x9e3779b97f4a7c15ull, b ^ 0xd1b54a32d192ed03ull, &high);
  return low ^ high;
}

/// Hash of count words word(i), chunk by chunk; the chunks are fixed, so threads do not matter.
template <typename Word>
std::uint64_t hashWords(std::size_t count, std::uint64_t seed, const Word& word)
{
  constexpr std::size_t chunk = 1 << 16;
  const std::size_t chunks = (count + chunk - 1) / chunk;
  std::vector<std::uint64_t> hashes(chunks);
  forEach(smpParallelFor(), chunks, 1,
    [&](std::size_t c)
    {
      // Four chains, so that a multiplication need not wait for the last one.
      std::uint64_t h[4] = { 1, 2, 3, 4 };
      const std::size_t end = std::min(count, (c + 1) * chunk);
      std::size_t i = c * chunk;
      for (; i + 4 <= end; i += 4)
      {
        for (std::size_t k = 0; k < 4; ++k)
        {
          h[k] = mix(h[k], word(i + k));
        }
      }
      for (; i < end; ++i)
      {
        h[0] = mix(h[0], word(i));
      }
      hashes[c] = mix(mix(h[0], h[1]), mix(h[2], h[3]));
    });
  std::uint64_t all = mix(seed, count);
  for (std::uint64_t h : hashes)
  {
    all = mix(all, h);
  }
  return all;
}

template <typename Bits, typename Value>
std::uint64_t hashValues(const Value* values, std::size_t count)
{
  static_assert(sizeof(Bits) == sizeof(Value), "bits of a value");
  return hashWords(count, sizeof(Value),
    [values](std::size_t i)
    {
      Bits bits;
      std::memcpy(&bits, values + i, sizeof(Value));
      return static_cast<std::uint64_t>(bits);
    });
}

std::uint64_t hashPoints(vtkPoints* points)
{
  vtkDataArray* data = points->GetData();
  const auto count = static_cast<std::size_t>(data->GetNumberOfValues());
  if (auto* floats = vtkFloatArray::FastDownCast(data))
  {
    return hashValues<std::uint32_t>(floats->GetPointer(0), count);
  }
  if (auto* doubles = vtkDoubleArray::FastDownCast(data))
  {
    return hashValues<std::uint64_t>(doubles->GetPointer(0), count);
  }
  std::uint64_t all = mix(1, count);
  double x[3];
  for (vtkIdType i = 0; i < data->GetNumberOfTuples(); ++i)
  {
    data->GetTuple(i, x);
    for (double v : x)
    {
      std::uint64_t bits;
      std::memcpy(&bits, &v, sizeof(bits));
      all = mix(all, bits);
    }
  }
  return all;
}

/// The same for the same cells, whether VTK stores their ids in 32 or 64 bits or computes offsets.
std::uint64_t hashCells(vtkCellArray* cells)
{
  const auto offsetCount = static_cast<std::size_t>(cells->GetNumberOfCells()) + 1;
  const auto idCount = static_cast<std::size_t>(cells->GetNumberOfConnectivityIds());
  std::uint64_t all = 0;
  useCellIds(cells,
    [&](const auto* offsets, const auto* ids)
    {
      const auto hash = [](const auto* values, std::size_t count)
      {
        return hashWords(
          count, 0, [values](std::size_t i) { return static_cast<std::uint64_t>(values[i]); });
      };
      all = mix(hash(offsets, offsetCount), hash(ids, idCount));
    });
  return all;
}

/// VTK's modification times grow over the whole process, so an object that is made where another
/// one was freed never shows the same pair of address and time: entries need no reference, and
/// outdated ones are harmless.
class Memory
{
public:
  template <typename Compute>
  std::uint64_t get(const void* object, vtkMTimeType time, const Compute& compute)
  {
    const Key key(object, time);
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      const auto found = this->Hashes.find(key);
      if (found != this->Hashes.end())
      {
        return found->second;
      }
    }
    const std::uint64_t hash = compute();
    const std::lock_guard<std::mutex> lock(this->Mutex);
    ++this->Computed;
    this->keep(key, hash);
    return hash;
  }

  void put(const void* object, vtkMTimeType time, std::uint64_t hash)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->keep({ object, time }, hash);
  }

  std::uint64_t computed()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return this->Computed;
  }

private:
  using Key = std::pair<const void*, vtkMTimeType>;

  void keep(const Key& key, std::uint64_t hash)
  {
    if (this->Hashes.emplace(key, hash).second)
    {
      this->Order.push_back(key);
    }
    if (this->Order.size() > Most)
    {
      // The older half goes, which is rare enough to be simple.
      for (std::size_t i = 0; i < Most / 2; ++i)
      {
        this->Hashes.erase(this->Order[i]);
      }
      this->Order.erase(this->Order.begin(), this->Order.begin() + Most / 2);
    }
  }

  static constexpr std::size_t Most = 8192;
  std::mutex Mutex;
  std::map<Key, std::uint64_t> Hashes;
  std::vector<Key> Order;
  std::uint64_t Computed = 0;
};

Memory& memory()
{
  static Memory instance;
  return instance;
}

/// When somebody last said that the mesh changed: whoever writes ids or coordinates in place may
/// say so to the mesh alone.
vtkMTimeType saidAt(vtkPolyData* mesh)
{
  return mesh->vtkObject::GetMTime();
}

vtkMTimeType timeOf(vtkCellArray* cells)
{
  return std::max({ cells->GetMTime(), cells->GetOffsetsArray()->GetMTime(),
    cells->GetConnectivityArray()->GetMTime() });
}

std::uint64_t cellsHash(vtkCellArray* cells, vtkMTimeType said)
{
  return cells->GetNumberOfCells() == 0
    ? 0
    : memory().get(cells, std::max(timeOf(cells), said), [cells] { return hashCells(cells); });
}

/// A vtkPoints can be given another array without looking younger: the array is the identity.
std::uint64_t pointsHash(vtkPoints* points, vtkMTimeType said)
{
  return !points || points->GetNumberOfPoints() == 0
    ? 0
    : memory().get(points->GetData(), std::max(points->GetMTime(), said),
        [points] { return hashPoints(points); });
}
}

std::uint64_t meshSignature(vtkPolyData* mesh)
{
  const vtkMTimeType said = saidAt(mesh);
  std::uint64_t all = pointsHash(mesh->GetPoints(), said);
  all = mix(all, cellsHash(mesh->GetPolys(), said));
  all = mix(all, cellsHash(mesh->GetStrips(), said));
  all = mix(all, static_cast<std::uint64_t>(mesh->GetNumberOfVerts()));
  all = mix(all, static_cast<std::uint64_t>(mesh->GetNumberOfLines()));
  return all != 0 ? all : 1;
}

void copySignature(vtkPolyData* from, vtkPolyData* to)
{
  const vtkMTimeType said = saidAt(from), saidOfCopy = saidAt(to);
  const auto copy = [&](const void* object, vtkMTimeType time, std::uint64_t hash)
  { memory().put(object, std::max(time, saidOfCopy), hash); };
  if (vtkPoints* points = to->GetPoints(); points && points->GetNumberOfPoints() > 0)
  {
    copy(points->GetData(), points->GetMTime(), pointsHash(from->GetPoints(), said));
  }
  const auto copyCells = [&](vtkCellArray* own, vtkCellArray* original)
  {
    if (own->GetNumberOfCells() > 0)
    {
      copy(own, timeOf(own), cellsHash(original, said));
    }
  };
  copyCells(to->GetPolys(), from->GetPolys());
  copyCells(to->GetStrips(), from->GetStrips());
}

std::uint64_t numberOfHashedArrays()
{
  return memory().computed();
}
}
