// All rows of a run, and the files they go to.
#ifndef svoResults_h
#define svoResults_h

#include <string>
#include <vector>

#include <vtk_jsoncpp.h>

namespace svobench
{
/// The settings of a measurement and its figures, one level deep.
using Row = Json::Value;

class Results
{
public:
  /// Names the keys that are printed.
  explicit Results(const std::vector<std::string>& shown)
    : Shown(shown)
  {
  }
  /// Prints a line and keeps the row. "experiment" is the first key of every row.
  void add(const Row& row);
  const Json::Value& rows() const { return this->Rows; }
  /// One array of objects; a key that a row lacks is no figure of it.
  bool writeJson(const std::string& path) const;
  /// One line a row, one column for every key of any row.
  bool writeCsv(const std::string& path) const;

private:
  std::vector<std::string> Shown;
  Json::Value Rows{ Json::arrayValue };
};
}

#endif
