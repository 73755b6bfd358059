// A value that its copies share: copying it costs a reference, and whoever writes to a copy changes
// that copy alone.
#ifndef svoShared_h
#define svoShared_h

#include <cstddef>
#include <memory>
#include <utility>

namespace svo
{
/// As with any value, no copy is written to, assigned or destroyed by one thread while another one
/// uses that same copy. One that was moved from has no value until it gets another one.
template <class T>
class Shared
{
public:
  Shared()
    : Value(initial())
  {
  }
  explicit Shared(T value)
    : Value(std::make_shared<T>(std::move(value)))
  {
  }

  const T& operator*() const { return *this->Value; }
  const T* operator->() const { return this->Value.get(); }

  /// To write to: the value of this copy alone, cloned where others share it. No other copy is made
  /// meanwhile.
  T& own()
  {
    if (this->Value.use_count() != 1)
    {
      this->Value = std::make_shared<T>(*this->Value);
    }
    return *this->Value;
  }
  /// To write to: the value of this copy and of all that share it. For whoever knows all of them;
  /// see holders().
  T& all() { return *this->Value; }
  /// Copies that share the value, this one counted.
  std::size_t holders() const { return static_cast<std::size_t>(this->Value.use_count()); }

  /// Whether both share one value.
  bool same(const Shared& other) const { return this->Value == other.Value; }

private:
  /// So that copies that are about to be assigned cost no memory. The holder in here keeps everyone
  /// else from writing to it.
  static const std::shared_ptr<T>& initial()
  {
    static const std::shared_ptr<T> value = std::make_shared<T>();
    return value;
  }

  std::shared_ptr<T> Value;
};
}

#endif
