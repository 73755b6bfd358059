// Frames in a file, for another commit's to be compared with, pixel by pixel: where two commits
// round differently, digests say nothing.
#ifndef framePictures_h
#define framePictures_h

#include "svoFrame.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

/// Writes the frames that it takes, or compares them with those of a file.
class FramePictures
{
public:
  /// False if the file cannot be opened.
  bool write(const std::string& file) { return (this->Out = std::fopen(file.c_str(), "wb")); }
  bool compareWith(const std::string& file) { return (this->In = std::fopen(file.c_str(), "rb")); }
  bool compares() const { return this->In != nullptr; }

  ~FramePictures()
  {
    for (std::FILE* file : { this->Out, this->In })
    {
      if (file)
      {
        std::fclose(file);
      }
    }
  }

  void take(const std::string& name, const svo::Frame& frame)
  {
    if (this->Out)
    {
      this->put(frame.color);
      this->put(frame.depth);
      this->put(frame.instance);
      this->put(frame.primitive);
    }
    if (this->In)
    {
      this->compare(name, frame);
    }
  }

  /// What all frames together differed by.
  void report() const
  {
    std::printf("%lld pixels: colour the same %lld, by 1 of 255 %lld, by more %lld (at most %d); "
                "instance or primitive differs %lld; depth differs %lld\n",
      this->Pixels, this->Colors[0], this->Colors[1], this->Colors[2], this->Most, this->Names,
      this->Depths);
  }

private:
  template <class T>
  void put(const std::vector<T>& values)
  {
    std::fwrite(values.data(), sizeof(T), values.size(), this->Out);
  }
  template <class T>
  std::vector<T> get(const std::vector<T>& like)
  {
    std::vector<T> values(like.size());
    if (std::fread(values.data(), sizeof(T), values.size(), this->In) != values.size())
    {
      std::fprintf(stderr, "The file ends before its frames do.\n");
      std::exit(1);
    }
    return values;
  }

  void compare(const std::string& name, const svo::Frame& frame)
  {
    const std::vector<std::uint8_t> color = this->get(frame.color);
    const std::vector<float> depth = this->get(frame.depth);
    const std::vector<std::uint32_t> instance = this->get(frame.instance);
    const std::vector<svo::Primitive> primitive = this->get(frame.primitive);
    int more = 0;
    for (std::size_t i = 0; i < depth.size(); ++i)
    {
      int off = 0;
      for (std::size_t c = 4 * i; c < 4 * i + 4; ++c)
      {
        off = std::max(off, std::abs(color[c] - frame.color[c]));
      }
      ++this->Colors[std::min(off, 2)];
      this->Most = std::max(this->Most, off);
      this->Names += instance[i] != frame.instance[i] || primitive[i] != frame.primitive[i];
      this->Depths += depth[i] != frame.depth[i];
      if (off > 1 && more++ < 3)
      {
        std::printf("%s: pixel %d, %d of instance %u, primitive %u: %d, not %d\n", name.c_str(),
          static_cast<int>(i) % frame.width, static_cast<int>(i) / frame.width, instance[i],
          primitive[i], frame.color[4 * i], color[4 * i]);
      }
    }
    this->Pixels += static_cast<long long>(depth.size());
  }

  std::FILE *Out = nullptr, *In = nullptr;
  long long Pixels = 0, Names = 0, Depths = 0;
  long long Colors[3] = { 0, 0, 0 }; // pixels, by how much their colour differs; more is 2
  int Most = 0;
};

#endif
