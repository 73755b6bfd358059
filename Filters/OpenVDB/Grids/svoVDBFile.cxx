#include "svoVDBFile.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
#include <new>
#include <sstream>

#include <openvdb/io/Archive.h>
#include <openvdb/io/File.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/openvdb.h>

namespace svo
{
namespace
{
/// Finds out whether a file has all bytes of the grids that it names: OpenVDB reads on where there
/// are none.
class WholeFile : public openvdb::io::Archive
{
public:
  bool check(const std::string& fileName)
  {
    std::ifstream in(fileName, std::ios::binary | std::ios::ate);
    const std::int64_t size = in.tellg();
    in.seekg(0);
    in.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    this->readHeader(in);
    this->setFormatVersion(in);
    this->setLibraryVersion(in);
    openvdb::MetaMap().readMeta(in);
    if (!this->inputHasGridOffsets())
    {
      return true; // a stream: OpenVDB says so itself
    }
    const std::int32_t count = readGridCount(in);
    for (std::int32_t i = 0; i < count; ++i)
    {
      openvdb::io::GridDescriptor grid;
      grid.read(in);
      if (grid.getEndPos() < in.tellg() || grid.getEndPos() > size)
      {
        return false;
      }
      grid.seekToEnd(in);
    }
    return true;
  }
};

/// Runs what may throw; returns why it failed, or nothing.
std::string guarded(const std::function<std::string()>& run)
{
  try
  {
    openvdb::initialize(); // costs nothing from the second time on
    return run();
  }
  catch (const std::bad_alloc&)
  {
    return "there is not enough memory for it";
  }
  catch (const std::ios_base::failure&)
  {
    return EndsTooEarly;
  }
  catch (const std::exception& failure)
  {
    return failure.what();
  }
}

void addLines(const openvdb::MetaMap& map, std::vector<std::string>& lines)
{
  for (auto entry = map.beginMeta(); entry != map.endMeta(); ++entry)
  {
    lines.push_back(entry->first + ": " + (entry->second ? entry->second->str() : std::string()));
  }
}

/// Opens the file and lists what is in it; why it cannot be, or nothing.
std::string open(const std::string& fileName, openvdb::io::File& file, VDBContents& contents)
{
  if (!std::ifstream(fileName, std::ios::binary))
  {
    return "it cannot be opened";
  }
  if (!WholeFile().check(fileName))
  {
    return EndsTooEarly;
  }
  // Without delayed loading: what is missing is missed here, and not while rays are traced.
  file.open(false);
  for (auto name = file.beginName(); name != file.endName(); ++name)
  {
    contents.grids.push_back(*name);
  }
  if (const openvdb::MetaMap::Ptr metadata = file.getMetadata())
  {
    addLines(*metadata, contents.metadata);
  }
  return {};
}
}

std::string uniqueName(const VDBContents& contents, const std::string& name)
{
  const std::vector<std::string>& names = contents.grids;
  if (name.empty())
  {
    return names.empty() ? std::string() : names.front();
  }
  for (const std::string& wanted : { name, name + "[0]" })
  {
    if (const auto found = std::find(names.begin(), names.end(), wanted); found != names.end())
    {
      return *found;
    }
  }
  return {};
}

std::string readVDBContents(const std::string& fileName, VDBContents& contents)
{
  contents = {};
  return guarded(
    [&]
    {
      openvdb::io::File file(fileName);
      return open(fileName, file, contents);
    });
}

std::string readVDBGrid(const std::string& fileName, const std::string& name,
  openvdb::GridBase::ConstPtr& grid, VDBContents& contents)
{
  grid = nullptr;
  contents = {};
  return guarded(
    [&]() -> std::string
    {
      openvdb::io::File file(fileName);
      std::string reason = open(fileName, file, contents);
      if (!reason.empty())
      {
        return reason;
      }
      const std::vector<std::string>& names = contents.grids;
      if (names.empty())
      {
        return "it has no grids";
      }
      const std::string unique = uniqueName(contents, name);
      if (unique.empty())
      {
        std::string all;
        for (const std::string& other : names)
        {
          all += (all.empty() ? "\"" : ", \"") + other + "\"";
        }
        return "it has no grid \"" + name + "\", but " + all;
      }
      grid = file.readGrid(unique);
      return grid ? std::string() : std::string("the grid could not be read");
    });
}

std::vector<std::string> metadataOf(const openvdb::GridBase& grid)
{
  std::ostringstream map;
  grid.transform().print(map, "");
  std::string transform = map.str();
  std::replace(transform.begin(), transform.end(), '\n', ' ');
  std::vector<std::string> lines = { "type: " + grid.valueType(),
    "class: " + openvdb::GridBase::gridClassToString(grid.getGridClass()),
    "transform: " + transform };
  addLines(grid, lines);
  return lines;
}

std::string writeVDBFile(
  const std::string& fileName, const openvdb::GridCPtrVec& grids, const openvdb::MetaMap& metadata)
{
  const std::string part = fileName + ".part";
  std::string reason = guarded(
    [&]() -> std::string
    {
      if (!std::ofstream(part, std::ios::binary))
      {
        return "it cannot be opened for writing";
      }
      openvdb::io::File(part).write(grids, metadata);
      if (!WholeFile().check(part))
      {
        return "not all of it could be written";
      }
      if (std::rename(part.c_str(), fileName.c_str()) != 0)
      {
        return "it cannot be replaced";
      }
      return {};
    });
  if (!reason.empty())
  {
    std::remove(part.c_str());
  }
  return reason;
}
}
