#include "svoReuse.h"

#include "svoEraseIf.h"

#include <algorithm>
#include <limits>

namespace svo
{
void ReuseHistory::comes(Id id, bool kept)
{
  ++this->Now;
  const auto known = this->Things.find(id);
  if (known == this->Things.end())
  {
    if (this->Things.size() == Most)
    {
      this->forget();
    }
    this->Things[id] = { this->Now, 0 };
    return;
  }
  Thing& thing = known->second;
  thing.interval = this->Now - thing.last;
  thing.last = this->Now;
  if (!kept)
  {
    this->Loop = thing.interval;
  }
}

/// The older half, which is rare enough to be simple.
void ReuseHistory::forget()
{
  std::vector<std::uint64_t> times;
  for (const auto& entry : this->Things)
  {
    times.push_back(entry.second.last);
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  eraseIf(this->Things, [&](const auto& entry) { return entry.second.last < *middle; });
}

ReuseHistory::Rank ReuseHistory::rankOf(Id id) const
{
  const auto known = this->Things.find(id);
  const Thing thing = known != this->Things.end() ? known->second : Thing();
  // What came once is taken to be a part of the loop, if there is one.
  const std::uint64_t interval = thing.interval > 0 ? thing.interval : this->Loop;
  if (interval == 0)
  {
    return { 1, thing.last, id };
  }
  if (thing.last + interval + interval / 2 < this->Now)
  {
    return { 0, thing.last, id };
  }
  return { 2, std::numeric_limits<std::uint64_t>::max() - (thing.last + interval), id };
}

void ReuseHistory::sortForGoing(std::vector<Id>& ids) const
{
  std::vector<Rank> ranks;
  ranks.reserve(ids.size());
  for (const Id id : ids)
  {
    ranks.push_back(this->rankOf(id));
  }
  std::sort(ranks.begin(), ranks.end());
  std::transform(
    ranks.begin(), ranks.end(), ids.begin(), [](const Rank& rank) { return std::get<2>(rank); });
}
}
