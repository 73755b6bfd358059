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

/// Opens the file; why it cannot be, or nothing.
std::string open(const std::string& fileName, openvdb::io::File& file)
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
  return {};
}

VDBMetadata textOf(const openvdb::MetaMap& map)
{
  VDBMetadata text;
  for (auto entry = map.beginMeta(); entry != map.endMeta(); ++entry)
  {
    text.emplace_back(entry->first, entry->second ? entry->second->str() : std::string());
  }
  return text;
}

void list(const openvdb::io::File& file, VDBContents& contents)
{
  contents = {};
  for (auto name = file.beginName(); name != file.endName(); ++name)
  {
    contents.grids.push_back(*name);
  }
  if (const openvdb::MetaMap::Ptr metadata = file.getMetadata())
  {
    contents.metadata = textOf(*metadata);
  }
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
      std::string reason = open(fileName, file);
      if (reason.empty())
      {
        list(file, contents);
      }
      return reason;
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
      std::string reason = open(fileName, file);
      if (!reason.empty())
      {
        return reason;
      }
      list(file, contents);
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

VDBMetadata metadataOf(const openvdb::GridBase& grid)
{
  VDBMetadata text = { { "type", grid.valueType() },
    { "class", openvdb::GridBase::gridClassToString(grid.getGridClass()) } };
  std::ostringstream map;
  grid.transform().print(map, "");
  std::string line = map.str();
  std::replace(line.begin(), line.end(), '\n', ' ');
  text.emplace_back("transform", line);
  const VDBMetadata own = textOf(grid);
  text.insert(text.end(), own.begin(), own.end());
  return text;
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
