// An allocator of memory in pages of its own where it is large: those that no code writes are never
// touched, all of them go back to the system with the array, and some may do so before.
#ifndef svoPages_h
#define svoPages_h

#include <cstddef>
#include <new>

#if defined(__unix__) || defined(__APPLE__)
#include <sys/mman.h>
#include <unistd.h>
#define SVO_HAS_PAGES
#endif

namespace svo
{
/// For a RawArray of the size of an image of which only some tiles are used. Other allocators would
/// hand out again what has been touched before, and keep what lies between others.
template <class T>
struct Pages
{
  T* allocate(std::size_t count)
  {
#ifdef SVO_HAS_PAGES
    if (isLarge(count))
    {
      void* const pages =
        mmap(nullptr, count * sizeof(T), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANON, -1, 0);
      if (pages == MAP_FAILED)
      {
        throw std::bad_alloc();
      }
      return static_cast<T*>(pages);
    }
#endif
    return static_cast<T*>(::operator new(count * sizeof(T)));
  }

  void deallocate(T* elements, std::size_t count)
  {
#ifdef SVO_HAS_PAGES
    if (isLarge(count))
    {
      munmap(elements, count * sizeof(T));
      return;
    }
#endif
    ::operator delete(elements);
  }

  /// Of an array of `count` elements: gives back the pages that lie within [first, last), whose
  /// elements are undefined from then on.
  static void giveBack([[maybe_unused]] T* elements, [[maybe_unused]] std::size_t count,
    [[maybe_unused]] std::size_t first, [[maybe_unused]] std::size_t last)
  {
#ifdef SVO_HAS_PAGES
    static const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t begin = (first * sizeof(T) + page - 1) / page * page;
    const std::size_t end = last * sizeof(T) / page * page;
    if (isLarge(count) && begin < end)
    {
      madvise(reinterpret_cast<char*>(elements) + begin, end - begin, MADV_DONTNEED);
    }
#endif
  }

private:
  static bool isLarge(std::size_t count)
  {
    constexpr std::size_t Large = std::size_t(1) << 18; // bytes
    return count * sizeof(T) >= Large;
  }
};
}

#endif
