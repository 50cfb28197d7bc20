#pragma once

#include <string>
#include <vector>

namespace vocalis::io {

/// A quantity over time, as a file gives it.
struct Signal {
  std::vector<double> times;   ///< [s]
  std::vector<double> values;  ///< [unit of the file]
};

/// Reads a signal from a text file that somebody else wrote: one row a sample, the time [s] in the first column;
/// columns apart by commas, semicolons or blanks; empty lines and those that begin with "#" do not count; the first row
/// may hold the columns' names.
///
/// column  which column holds the values, by its name; empty: the second
/// One rank, not collective. Throws UserError (file and line) for a file that cannot be read, a row that is not made of
/// numbers or has another number of columns than the first, and a column that is not there.
Signal read_signal(const std::string& path, const std::string& column = "");

}  // namespace vocalis::io
