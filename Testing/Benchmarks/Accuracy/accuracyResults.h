// All rows of a run, and the files they go to.
#ifndef accuracyResults_h
#define accuracyResults_h

#include "accuracyMetrics.h"

#include <string>

namespace accuracy
{
class Results
{
public:
  /// Prints a line and keeps the row. "experiment" is the first key of every row.
  void add(const Row& row);
  const Json::Value& rows() const { return this->Rows; }
  /// One array of objects; a key that a row lacks is no figure of it.
  bool writeJson(const std::string& path) const;
  /// One line a row, one column for every key of any row.
  bool writeCsv(const std::string& path) const;

private:
  Json::Value Rows{ Json::arrayValue };
};
}

#endif
