// An array without initial values, in pages of its own where it is large: those of elements that no
// code writes are never touched.
#ifndef svoPagedArray_h
#define svoPagedArray_h

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>

#if defined(__unix__) || defined(__APPLE__)
#include <sys/mman.h>
#endif

namespace svo
{
/// For buffers of the size of images of which only some tiles are ever used: pages of the others
/// cost neither time nor memory, and all of them go back to the system with the array. An allocator
/// would hand out again what has been touched before, and keep what lies between others.
template <class T>
class PagedArray
{
  static_assert(std::is_trivially_copyable<T>::value, "elements start without a value");

public:
  PagedArray() = default;
  explicit PagedArray(std::size_t size) { this->resize(size); }

  /// Elements are undefined afterwards, unless the size stays as it is.
  void resize(std::size_t size)
  {
    if (size != this->Size)
    {
      this->Elements.reset(); // before there is another one
      this->Elements = Memory(static_cast<T*>(allocate(size * sizeof(T))), { size * sizeof(T) });
      this->Size = size;
    }
  }
  std::size_t size() const { return this->Size; }
  T* data() { return this->Elements.get(); }
  const T* data() const { return this->Elements.get(); }
  T& operator[](std::size_t i) { return this->Elements[i]; }
  const T& operator[](std::size_t i) const { return this->Elements[i]; }

private:
#if defined(__unix__) || defined(__APPLE__)
  static constexpr std::size_t Large = std::size_t(1) << 18; // bytes
#else
  static constexpr std::size_t Large = ~std::size_t(0);
#endif

  static void* allocate(std::size_t bytes)
  {
    if (bytes == 0)
    {
      return nullptr;
    }
#if defined(__unix__) || defined(__APPLE__)
    if (bytes >= Large)
    {
      void* const pages =
        mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANON, -1, 0);
      if (pages == MAP_FAILED)
      {
        throw std::bad_alloc();
      }
      return pages;
    }
#endif
    return ::operator new(bytes);
  }

  struct Free
  {
    std::size_t bytes = 0;
    void operator()(T* elements) const
    {
#if defined(__unix__) || defined(__APPLE__)
      if (this->bytes >= Large)
      {
        munmap(elements, this->bytes);
        return;
      }
#endif
      ::operator delete(elements);
    }
  };
  using Memory = std::unique_ptr<T[], Free>;

  Memory Elements;
  std::size_t Size = 0;
};
}

#endif
