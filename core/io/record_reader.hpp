#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/io/hdf5_rows.hpp"
#include "core/io/input_order.hpp"
#include "core/io/record_layout.hpp"

namespace vocalis::io {

/// Reads a record, written by a `RecordWriter` on any number of ranks, or by others. Rank 0 reads; a record's vertices
/// are found by their places, so that they may stand in any order, and there may be more than the mesh has.
class RecordReader {
 public:
  /// needed, optional  fields; those that are optional may be missing in the file
  /// The mesh, at rest, must outlive this. Collective. Throws UserError on every rank if the file is missing, no
  /// record, cut off, incomplete, of another version, or of another mesh.
  RecordReader(const std::string& path, const mesh::Mesh& mesh, std::vector<RecordLayout::Field> needed,
               const std::vector<RecordLayout::Field>& optional);

  /// Of each step [s], rising, from 0 on: time counts from the first step. At least two.
  const std::vector<double>& times() const { return times_; }
  bool has(const std::string& field) const;
  bool has_marks() const { return layout_.has_marks; }

  /// One field of one step, ghosts current. Collective. Throws UserError on every rank if the file is damaged there.
  std::vector<double> read(const std::string& field, std::int64_t step) const;
  /// (owned cells)
  std::vector<char> read_marks(std::int64_t step) const;

 private:
  /// On rank 0 alone.
  struct File {
    Hdf5Handle file;
    std::vector<Hdf5Rows> fields;  ///< as in the layout
    std::unique_ptr<Hdf5Rows> marks;
    std::vector<std::int64_t> vertex_row;  ///< in the file, of each vertex in input order
    std::vector<std::int64_t> cell_row, edge_row;
  };
  void open(const std::vector<double>& coordinates, const std::vector<RecordLayout::Field>& optional);
  void open_fields(std::int64_t steps, const std::vector<RecordLayout::Field>& optional);
  void read_times(std::int64_t steps);
  void find_mesh(const std::vector<double>& coordinates);
  std::size_t index_of(const std::string& field) const;

  std::string path_;
  const mesh::Mesh& mesh_;
  InputOrder order_;
  RecordLayout layout_;
  std::vector<double> times_;
  std::unique_ptr<File> file_;
};

}  // namespace vocalis::io
