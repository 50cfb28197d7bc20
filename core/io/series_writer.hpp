#pragma once

#include <mpi.h>

#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace vocalis::io {

/// Writes a time series file row by row: "# key: value" lines, a row of column names, rows of numbers with the 17
/// significant digits that give the same doubles back. Rank 0 alone has the file. `read_series` reads it.
class SeriesWriter {
 public:
  using Header = std::vector<std::pair<std::string, std::string>>;

  /// Begins a new file; an old one of that name is lost. The first lines are on the disk when this returns.
  /// header   keys and values: units, constants
  /// columns  names with their unit, "time_s", without commas
  /// Collective. Throws UserError on every rank if the file cannot be written.
  SeriesWriter(MPI_Comm comm, const std::string& path, const Header& header, const std::vector<std::string>& columns);

  /// Goes on with the file of a run that ended: keeps its rows up to the first one whose number in `column` is larger
  /// than `last`, or that was cut off; the rest is removed. The header stays as it is.
  /// column   index in `columns`; its numbers never fall
  /// Collective. Throws UserError on every rank if the file is missing, has other columns, or cannot be written.
  static SeriesWriter resume(MPI_Comm comm, const std::string& path, const std::vector<std::string>& columns,
                             int column, double last);

  /// Adds a row with one number a column; rank 0's numbers count. Not collective: trouble with the disk is told by
  /// `flush`.
  void write(std::span<const double> row);

  /// Hands all rows to the operating system, so that they survive the end of this process. Due before a checkpoint.
  /// Collective. Throws UserError on every rank if the disk has not taken them.
  void flush();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  SeriesWriter(MPI_Comm comm, const std::string& path, std::size_t num_columns);

  MPI_Comm comm_;
  std::string path_;
  std::size_t num_columns_;
  std::unique_ptr<std::FILE, Close> file_;  ///< rank 0 only
};

}  // namespace vocalis::io
