#include "core/io/series_writer.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"
#include "core/base/first_rank.hpp"

namespace vocalis::io {

namespace {

using base::UserError;

std::string names_row(const std::vector<std::string>& columns) { return fmt::format("{}", fmt::join(columns, ",")); }

[[noreturn]] void throw_not_written(const std::string& path, int number) {
  throw UserError("the series file " + path + " must be writable", std::strerror(number),
                  "check that the folder exists, its permissions, and the free space of the disk");
}

std::FILE* open(const std::string& path, const char* mode) {
  std::FILE* file = std::fopen(path.c_str(), mode);
  if (!file) throw_not_written(path, errno);
  return file;
}

/// Whether a line is a whole row whose number in `column` is at most `last`.
bool stays(const std::string& line, std::size_t num_columns, int column, double last) {
  std::size_t begin = 0, count = 0;
  double value = 0;
  while (true) {
    const std::size_t end = line.find(',', begin);
    if (count++ == static_cast<std::size_t>(column)) value = std::strtod(line.c_str() + begin, nullptr);
    if (end == std::string::npos) break;
    begin = end + 1;
  }
  return count == num_columns && value <= last;
}

/// How many bytes of the file stay. Throws UserError if its columns are others.
std::uintmax_t bytes_that_stay(const std::string& path, const std::vector<std::string>& columns, int column,
                               double last) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw UserError("the series file " + path + " must be there to be continued", std::strerror(errno),
                    "put the file back, or run the case again from its start");
  }
  std::uintmax_t bytes = 0;
  bool has_names = false;
  for (std::string line; std::getline(file, line) && !file.eof();) {
    if (has_names && !stays(line, columns.size(), column, last)) break;
    if (!has_names && !line.starts_with("#")) {
      if (line != names_row(columns)) {
        throw UserError("the columns of " + path + " must be those of this run: " + names_row(columns), line,
                        "resume with the settings of the run that wrote it, or run the case again from its start");
      }
      has_names = true;
    }
    bytes += line.size() + 1;
  }
  if (!has_names) {
    throw UserError("the series file " + path + " needs a row of column names to be continued", "none",
                    "run the case again from its start");
  }
  return bytes;
}

}  // namespace

SeriesWriter::SeriesWriter(MPI_Comm comm, const std::string& path, std::size_t num_columns)
    : comm_(comm), path_(path), num_columns_(num_columns) {}

SeriesWriter::SeriesWriter(MPI_Comm comm, const std::string& path, const Header& header,
                           const std::vector<std::string>& columns)
    : SeriesWriter(comm, path, columns.size()) {
  base::on_first_rank(comm, [&] {
    file_.reset(open(path, "w"));
    for (const auto& [key, value] : header) fmt::print(file_.get(), "# {}: {}\n", key, value);
    fmt::print(file_.get(), "{}\n", names_row(columns));
  });
  flush();
}

SeriesWriter SeriesWriter::resume(MPI_Comm comm, const std::string& path, const std::vector<std::string>& columns,
                                  int column, double last) {
  assert(column >= 0 && static_cast<std::size_t>(column) < columns.size());
  SeriesWriter writer(comm, path, columns.size());
  base::on_first_rank(comm, [&] {
    const std::uintmax_t bytes = bytes_that_stay(path, columns, column, last);
    std::error_code code;
    std::filesystem::resize_file(path, bytes, code);
    if (code) throw_not_written(path, code.value());
    writer.file_.reset(open(path, "a"));
  });
  return writer;
}

void SeriesWriter::write(std::span<const double> row) {
  if (!file_) return;
  assert(row.size() == num_columns_);
  fmt::memory_buffer line;
  for (const double value : row) fmt::format_to(std::back_inserter(line), "{:.17g},", value);
  line.data()[line.size() - 1] = '\n';
  std::fwrite(line.data(), 1, line.size(), file_.get());
}

void SeriesWriter::flush() {
  base::on_first_rank(comm_, [this] {
    const bool failed_before = std::ferror(file_.get()) != 0;
    if (std::fflush(file_.get()) != 0 || failed_before) throw_not_written(path_, failed_before ? EIO : errno);
  });
}

}  // namespace vocalis::io
