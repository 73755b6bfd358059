// An array that is not cleared: for large scratch memory that is written before it is read.
#ifndef svoBuffer_h
#define svoBuffer_h

#include <cstddef>
#include <memory>
#include <type_traits>

namespace svo
{
template <typename T>
class Buffer
{
  static_assert(std::is_trivially_copyable<T>::value, "elements start without a value");

public:
  Buffer() = default;
  explicit Buffer(std::size_t size)
    : Items(new T[size])
    , Count(size)
  {
  }

  T* data() { return this->Items.get(); }
  const T* data() const { return this->Items.get(); }
  std::size_t size() const { return this->Count; }
  T& operator[](std::size_t i) { return this->Items[i]; }
  const T& operator[](std::size_t i) const { return this->Items[i]; }

private:
  std::unique_ptr<T[]> Items;
  std::size_t Count = 0;
};
}

#endif
