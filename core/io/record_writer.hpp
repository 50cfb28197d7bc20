#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/io/hdf5_rows.hpp"
#include "core/io/input_order.hpp"
#include "core/io/record_layout.hpp"

namespace vocalis::io {

/// Writes a record step by step. Rank 0 alone has the file. What was written counts from the next `flush` on: nothing
/// that the file says of itself changes before, so that a process that is killed leaves a file with the steps of the
/// last flush.
class RecordWriter {
 public:
  /// Begins a new file; an old one is lost. The mesh, at rest, must outlive this. Collective. Throws UserError on every
  /// rank if it cannot be written.
  RecordWriter(const std::string& path, const mesh::Mesh& mesh, RecordLayout layout);

  /// Goes on behind the first `steps` steps; the others are dropped. Collective. Throws UserError on every rank if the
  /// file is missing, has fewer, is damaged, or is of another mesh or layout.
  static RecordWriter resume(const std::string& path, const mesh::Mesh& mesh, RecordLayout layout, std::int64_t steps);

  /// Adds a step. Collective. Throws UserError on every rank if the disk does not take it.
  void write(const RecordStep& step);

  /// Hands all steps to the operating system, and then their number. Due before a checkpoint. Collective. Throws
  /// UserError on every rank if the disk does not take them.
  void flush();

 private:
  /// On rank 0 alone.
  struct File {
    Hdf5Handle file;
    Hdf5Rows time;
    std::vector<Hdf5Rows> fields;
    std::unique_ptr<Hdf5Rows> marks;
  };
  struct Nothing {};
  RecordWriter(Nothing, const std::string& path, const mesh::Mesh& mesh, RecordLayout layout);
  std::vector<double> place_at_rest() const;
  void create(const std::vector<double>& coordinates);
  void open(const std::vector<double>& coordinates, std::int64_t steps);
  static void count_steps(File& file);

  std::string path_;
  const mesh::Mesh* mesh_;
  RecordLayout layout_;
  InputOrder order_;
  std::unique_ptr<File> file_;
};

}  // namespace vocalis::io
