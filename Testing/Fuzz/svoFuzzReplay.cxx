// Feeds the corpus, and seeded mutations of it, to the fuzz target: the short run of the tests,
// which needs no clang.
//
//   FuzzOctreeReplay [--mutations n] [--seed s] [--only k] file-or-folder...
//   FuzzOctreeReplay --write-seeds folder      writes intact octrees of svofuzz::mesh()
//
// Every input has a number; before the target sees it the number is noted, and after a crash it is
// printed with the way to run that input alone. An input may take twenty seconds of all processors
// together, however busy these are with others.
#include "svoFuzzMesh.h"

#include "svoFieldSource.h"
#include "svoLayout.h"
#include "svoMeshOctree.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <sys/time.h>
#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace
{
using Bytes = std::vector<std::uint8_t>;
namespace fs = std::filesystem;

char Running[512]; // what to say if the input that is running is a finding

extern "C" void reportAndDie(int signal)
{
  // Only what a signal handler may do.
  const char* const reason = signal == SIGPROF ? "Endless: " : "Crashed: ";
  const ssize_t ignored = write(STDERR_FILENO, reason, std::strlen(reason)) +
    write(STDERR_FILENO, Running, std::strlen(Running));
  (void)ignored;
  std::_Exit(1);
}

Bytes readFile(const fs::path& path)
{
  std::ifstream in(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
}

/// Damages an octree in a few places. Numbers are aligned as those of the layout are.
class Mutator
{
public:
  explicit Mutator(std::uint64_t seed)
    : Random(seed)
  {
  }

  void apply(Bytes& bytes)
  {
    for (std::size_t n = 1 + this->below(4); n > 0; --n)
    {
      this->damage(bytes);
    }
  }

private:
  std::size_t below(std::size_t n) { return n > 0 ? this->Random() % n : 0; }

  /// Offset of a number: headers are small, so half of them are looked for there.
  std::size_t place(const Bytes& bytes, std::size_t width)
  {
    const bool header = this->below(3) == 0;
    const std::size_t end = header ? std::min(bytes.size(), sizeof(svo::Header)) : bytes.size();
    return end >= width ? this->below(end / width) * width : 0;
  }

  void damage(Bytes& bytes)
  {
    const std::size_t width = std::size_t(4) << this->below(2);
    if (bytes.size() < width)
    {
      bytes.resize(this->below(600));
      return;
    }
    const std::size_t at = this->place(bytes, width);
    const std::size_t other = this->place(bytes, width);
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + at, width);
    switch (this->below(10))
    {
      case 0:
      case 1:
        value ^= std::uint64_t(1) << this->below(8 * width);
        break;
      case 2:
        value = this->Random();
        break;
      case 3:
        value = this->below(40);
        break;
      case 4:
        value = ~std::uint64_t(0) >> this->below(64);
        break;
      case 5:
        value += this->below(9) - 4;
        break;
      case 6:
        std::memcpy(&value, bytes.data() + other, width);
        break;
      case 7: // a double's extremes
      {
        constexpr double Extremes[] = { 0.0, -1.0, 5e-324, 1e-308, 1e308, 1e300, 1e-290 };
        std::memcpy(&value, Extremes + this->below(std::size(Extremes)), width);
        break;
      }
      case 8:
        bytes.resize(this->below(2 * bytes.size()));
        return;
      default: // a node, or part of one, in the place of another
        std::memmove(bytes.data() + at, bytes.data() + other,
          std::min<std::size_t>(16, bytes.size() - std::max(at, other)));
        return;
    }
    std::memcpy(bytes.data() + at, &value, width);
  }

  std::mt19937_64 Random;
};

void run(const Bytes& bytes, const std::string& what)
{
  std::snprintf(Running, sizeof(Running), "%s\n", what.c_str());
  constexpr itimerval Most{ {}, { 20, 0 } }, None{};
  setitimer(ITIMER_PROF, &Most, nullptr);
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  setitimer(ITIMER_PROF, &None, nullptr);
}

void writeOctree(const svo::Header& h, const fs::path& file)
{
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(&h), static_cast<std::streamsize>(svo::bufferSize(h)));
}

/// A plane across the cube of the mesh.
struct Slope : svo::ScalarField
{
  double value(const glm::dvec3& at) const override { return at.x + 0.4 * at.y - 0.3 * at.z; }
  glm::dvec3 gradient(const glm::dvec3&) const override { return { 1.0, 0.4, -0.3 }; }
};

/// An octree of planes whose hull is said to be the mesh; transformed: sheared and mirrored.
void writePlanes(int level, bool transformed, const fs::path& folder)
{
  svo::BuildOptions options;
  options.level = level;
  options.leafGeometry = svo::LeafGeometry::Plane;
  options.modelLow = glm::dvec3(-0.5);
  options.modelHigh = glm::dvec3(0.5);
  if (transformed)
  {
    options.transform[0][0] = -2.0;
    options.transform[1][0] = 0.5;
    options.transform[3][2] = 0.1;
  }
  const Slope slope;
  const svo::BuildResult built = svo::build(svo::FieldSource(slope, { 0.0, 1.2, 0.0 }), options);
  svo::Header& h = *reinterpret_cast<svo::Header*>(built.data.get());
  h.pointCount = static_cast<std::uint64_t>(svofuzz::mesh()->GetNumberOfPoints());
  h.cellCount = static_cast<std::uint64_t>(svofuzz::mesh()->GetNumberOfCells());
  svofuzz::mesh()->GetBounds(h.meshBounds);
  writeOctree(h, folder / ((transformed ? "framed-" : "planes-") + std::to_string(level)));
}

int writeSeeds(const fs::path& folder)
{
  fs::create_directories(folder);
  for (const int level : { 1, 2, 3, 4, 5 })
  {
    svo::MeshOctreeOptions options;
    options.level = level;
    svo::Octree octree;
    std::string message;
    if (svo::buildMeshOctree(svofuzz::mesh(), options, octree, message) != svo::BuildStatus::Built)
    {
      std::fprintf(stderr, "%s\n", message.c_str());
      return 1;
    }
    writeOctree(octree.header(), folder / ("level-" + std::to_string(level)));
    writePlanes(level, false, folder);
  }
  writePlanes(4, true, folder);
  return 0;
}
}

int main(int argc, char* argv[])
{
  std::uint64_t mutations = 0, seed = 1;
  std::int64_t only = -1;
  std::vector<fs::path> files;
  for (int i = 1; i < argc; ++i)
  {
    const std::string argument = argv[i];
    const bool more = i + 1 < argc;
    if (argument == "--write-seeds" && more)
    {
      return writeSeeds(argv[i + 1]);
    }
    if (argument == "--mutations" && more)
    {
      mutations = std::strtoull(argv[++i], nullptr, 10);
    }
    else if (argument == "--seed" && more)
    {
      seed = std::strtoull(argv[++i], nullptr, 10);
    }
    else if (argument == "--only" && more)
    {
      only = std::strtoll(argv[++i], nullptr, 10);
    }
    else if (fs::is_directory(argument))
    {
      for (const fs::directory_entry& entry : fs::directory_iterator(argument))
      {
        files.push_back(entry.path());
      }
    }
    else
    {
      files.emplace_back(argument);
    }
  }
  std::sort(files.begin(), files.end());
  if (files.empty())
  {
    std::fprintf(stderr, "FuzzOctreeReplay: there is no corpus\n");
    return 1;
  }
  for (const int signal : { SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGPROF })
  {
    std::signal(signal, reportAndDie);
  }
  std::vector<Bytes> corpus;
  for (const fs::path& file : files)
  {
    corpus.push_back(readFile(file));
    run(corpus.back(), "the corpus file " + file.string());
  }
  for (std::uint64_t k = 0; k < mutations; ++k)
  {
    if (only >= 0 && k != static_cast<std::uint64_t>(only))
    {
      continue;
    }
    Bytes bytes = corpus[k % corpus.size()];
    Mutator(seed * 0x9e3779b97f4a7c15ull + k).apply(bytes);
    run(bytes,
      "mutation " + std::to_string(k) + "; run it alone with --mutations " + std::to_string(k + 1) +
        " --seed " + std::to_string(seed) + " --only " + std::to_string(k));
  }
  std::printf("%zu corpus files, %llu mutations: %zu traced, the others refused\n", files.size(),
    static_cast<unsigned long long>(mutations), svofuzz::traced);
  return only >= 0 || svofuzz::traced > 0 ? 0 : 1; // a target that refuses everything is no test
}
