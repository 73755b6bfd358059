#include "svoResults.h"

#include <cmath>
#include <fstream>
#include <iostream>
#include <set>

namespace svobench
{
namespace
{
/// Four digits are more than any figure here is good for.
double rounded(double value)
{
  if (value == 0.0 || !std::isfinite(value))
  {
    return value;
  }
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 3.0);
  return std::round(value / unit) * unit;
}

std::string text(const Json::Value& value)
{
  if (value.isNull())
  {
    return "";
  }
  if (value.isString())
  {
    return value.asString();
  }
  if (value.type() == Json::realValue)
  {
    char buffer[32];
    std::snprintf(buffer, sizeof(buffer), "%.4g", value.asDouble());
    return buffer;
  }
  return value.toStyledString().substr(0, value.toStyledString().find('\n'));
}
}

void Results::add(const Row& row)
{
  Row kept = row;
  for (const std::string& key : row.getMemberNames())
  {
    if (row[key].type() == Json::realValue) // isDouble() is true for integers
    {
      kept[key] = rounded(row[key].asDouble());
    }
  }
  this->Rows.append(kept);
  for (const std::string& key : this->Shown)
  {
    if (kept.isMember(key))
    {
      std::cout << key << " " << text(kept[key]) << "  ";
    }
  }
  std::cout << std::endl;
}

bool Results::writeJson(const std::string& path) const
{
  std::ofstream file(path);
  Json::StreamWriterBuilder builder;
  builder["indentation"] = "";
  builder["precision"] = 5;
  file << "[\n";
  for (Json::ArrayIndex i = 0; i < this->Rows.size(); ++i)
  {
    file << Json::writeString(builder, this->Rows[i]) << (i + 1 < this->Rows.size() ? ",\n" : "\n");
  }
  file << "]\n";
  return static_cast<bool>(file);
}

bool Results::writeCsv(const std::string& path) const
{
  std::set<std::string> keys;
  for (const Row& row : this->Rows)
  {
    for (const std::string& key : row.getMemberNames())
    {
      keys.insert(key);
    }
  }
  std::ofstream file(path);
  const char* separator = "";
  for (const std::string& key : keys)
  {
    file << separator << key;
    separator = ",";
  }
  file << "\n";
  for (const Row& row : this->Rows)
  {
    separator = "";
    for (const std::string& key : keys)
    {
      const std::string value = text(row.get(key, Json::nullValue));
      const bool quote = value.find(',') != std::string::npos;
      file << separator << (quote ? "\"" + value + "\"" : value);
      separator = ",";
    }
    file << "\n";
  }
  return static_cast<bool>(file);
}
}
