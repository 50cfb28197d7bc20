#include "core/io/signal_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "core/base/case_table.hpp"
#include "core/base/error.hpp"

namespace vocalis::io {

namespace {

std::vector<std::string> split(const std::string& line) {
  constexpr const char* blanks = ",; \t\r";
  std::vector<std::string> parts;
  for (std::size_t begin = line.find_first_not_of(blanks); begin != std::string::npos;) {
    const std::size_t end = line.find_first_of(blanks, begin);
    parts.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blanks, end);
  }
  return parts;
}

/// Whether a text is a number and nothing else.
bool is_number(const std::string& text, double& value) {
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0';
}

/// The place of the values among the columns, of which `names` are empty if the file has none.
std::size_t place_of(const std::string& column, const std::vector<std::string>& names, const std::string& path) {
  if (column.empty()) return 1;
  const auto found = std::find(names.begin(), names.end(), column);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  throw base::UserError(path + " has no column of this name", "\"" + column + "\"",
                        names.empty() ? "its first row holds no names: leave column out to take the second column"
                                      : base::did_you_mean(column, names));
}

}  // namespace

Signal read_signal(const std::string& path, const std::string& column) {
  std::ifstream file(path);
  if (!file) throw base::UserError("the signal must be a readable file", path, "check the name and its rights");
  Signal signal;
  std::vector<std::string> names;
  std::size_t columns = 0, place = 0;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::vector<std::string> parts = split(line);
    if (parts.empty() || parts.front().front() == '#') continue;
    double time = 0, value = 0;
    if (columns == 0) {
      columns = parts.size();
      if (!is_number(parts.front(), time)) names = parts;
      place = place_of(column, names, path);
      if (!names.empty() && columns > place) continue;
    }
    if (parts.size() != columns || place >= columns || !is_number(parts.front(), time) ||
        !is_number(parts[place], value)) {
      throw base::UserError(
          fmt::format("{}:{}: every row of a signal holds a time [s] and a value, and as many columns "
                      "as the first row",
                      path, number),
          "\"" + line.substr(0, 60) + "\"",
          "write one row a sample, for example 0.001,0.25 (decimal point, not comma)");
    }
    signal.times.push_back(time);
    signal.values.push_back(value);
  }
  return signal;
}

}  // namespace vocalis::io
