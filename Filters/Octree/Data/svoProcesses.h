// Other processes that hold a part of the scene each.
#ifndef svoProcesses_h
#define svoProcesses_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace svo
{
/// All calls are collective: every process makes them, in the same order.
class Processes
{
public:
  virtual ~Processes() = default;
  virtual int count() const = 0;
  virtual int self() const = 0; // 0..count() - 1

  /// Everybody's bytes, one behind the other in the order of the processes, which may differ in how
  /// many they have; `begins`: where each one's begin, and the end of all.
  virtual void gather(const std::vector<unsigned char>& own, std::vector<unsigned char>& all,
    std::vector<std::size_t>& begins) = 0;

  /// Replaces each value by the smallest that a process has in its place.
  virtual void minimum(std::vector<std::uint64_t>& values) = 0;
};

/// Everybody's records, in the order of the processes; returns where each process's begin, and the
/// end of all.
template <class Record>
std::vector<std::size_t> gatherRecords(
  Processes& processes, const std::vector<Record>& own, std::vector<Record>& all)
{
  static_assert(std::is_trivially_copyable<Record>::value, "records travel as bytes");
  const auto* const begin = reinterpret_cast<const unsigned char*>(own.data());
  const std::vector<unsigned char> bytes(begin, begin + own.size() * sizeof(Record));
  std::vector<unsigned char> allBytes;
  std::vector<std::size_t> begins;
  processes.gather(bytes, allBytes, begins);
  all.resize(allBytes.size() / sizeof(Record));
  std::copy(allBytes.begin(), allBytes.end(), reinterpret_cast<unsigned char*>(all.data()));
  for (std::size_t& first : begins)
  {
    first /= sizeof(Record);
  }
  return begins;
}
}

#endif
