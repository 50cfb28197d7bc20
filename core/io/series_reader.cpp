#include "core/io/series_reader.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "core/base/error.hpp"

namespace vocalis::io {

namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> parts;
  std::stringstream stream(line);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

void read_header_line(const std::string& line, Series& series) {
  const std::size_t colon = line.find(": ");
  if (colon == std::string::npos || colon < 2) return;
  series.header[line.substr(2, colon - 2)] = line.substr(colon + 2);
}

}  // namespace

const std::vector<double>* Series::find(const std::string& column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  return found == columns.end() ? nullptr : &values[found - columns.begin()];
}

Series read_series(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw base::UserError("the series file must be readable", path, "give the folder of a run that has it");
  Series series;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#")) {
      read_header_line(line, series);
    } else if (series.columns.empty()) {
      series.columns = split(line);
      series.values.resize(series.columns.size());
    } else {
      const auto parts = split(line);
      if (file.eof() || parts.size() != series.columns.size()) break;
      for (std::size_t i = 0; i < parts.size(); ++i) series.values[i].push_back(std::strtod(parts[i].c_str(), nullptr));
    }
  }
  if (series.columns.empty()) {
    throw base::UserError("a series file needs a row of column names", path,
                          "the run that wrote it was cut off; run again");
  }
  return series;
}

}  // namespace vocalis::io
