// An array without initial values: memory of elements that no code writes is never touched.
#ifndef svoRawArray_h
#define svoRawArray_h

#include <cstddef>
#include <memory>
#include <type_traits>

namespace svo
{
/// For large scratch memory that is written before it is read. Of the allocator allocate() and
/// deallocate() are asked.
template <class T, class Allocator = std::allocator<T>>
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
      this->Elements.reset(); // before there is another one
      this->Elements = Memory(size > 0 ? Allocator().allocate(size) : nullptr, Free{ size });
      this->Size = size;
    }
  }
  std::size_t size() const { return this->Size; }
  T* data() { return this->Elements.get(); }
  const T* data() const { return this->Elements.get(); }
  T& operator[](std::size_t i) { return this->Elements[i]; }
  const T& operator[](std::size_t i) const { return this->Elements[i]; }

private:
  struct Free
  {
    std::size_t size = 0;
    void operator()(T* elements) const { Allocator().deallocate(elements, this->size); }
  };
  using Memory = std::unique_ptr<T[], Free>;

  Memory Elements;
  std::size_t Size = 0;
};
}

#endif
