#pragma once

#include <map>
#include <string>
#include <vector>

namespace vocalis::io {

/// A time series file as `SeriesWriter` leaves it: "# key: value" lines, a row of column names, rows of numbers.
struct Series {
  std::map<std::string, std::string> header;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> values;  ///< one vector a column

  /// A column by name; nullptr if there is none.
  const std::vector<double>* find(const std::string& column) const;
};

/// Reads a whole file; a last row that was cut off is left out. One rank, not collective. Throws UserError if it is
/// missing or has no row of names.
Series read_series(const std::string& path);

}  // namespace vocalis::io
