// An array without initial values: memory of elements that no code writes is never touched.
#ifndef svoRawArray_h
#define svoRawArray_h

#include <cstddef>
#include <memory>
#include <type_traits>

namespace svo
{
/// For large scratch memory that is written before it is read, and for image-sized buffers of which
/// only some tiles are ever used: the pages of the others are never touched, so they cost neither
/// time nor memory.
template <class T>
class RawArray
{
  static_assert(std::is_trivially_copyable<T>::value, "elements start without a value");

public:
  RawArray() = default;
  explicit RawArray(std::size_t size) { this->resize(size); }

  /// Elements are undefined afterwards, unless the size stays as it is.
  void resize(std::size_t size)
  {
    if (size != this->Size)
    {
      this->Elements.reset(size > 0 ? new T[size] : nullptr);
      this->Size = size;
    }
  }
  std::size_t size() const { return this->Size; }
  T* data() { return this->Elements.get(); }
  const T* data() const { return this->Elements.get(); }
  T& operator[](std::size_t i) { return this->Elements[i]; }
  const T& operator[](std::size_t i) const { return this->Elements[i]; }

private:
  std::unique_ptr<T[]> Elements;
  std::size_t Size = 0;
};
}

#endif
