#pragma once

#include <string>
#include <vector>

#include "core/io/hdf5_handle.hpp"

namespace vocalis::io {

/// A dataset that grows by rows: (rows, shape...), in compressed chunks with a checksum each; rows of one number are
/// not compressed. One rank; all throw Hdf5Error.
class Hdf5Rows {
 public:
  /// Makes an empty one; type is what the file holds.
  static Hdf5Rows create(hid_t file, const std::string& name, hid_t type, const std::vector<hsize_t>& shape);
  /// Opens one that is there.
  static Hdf5Rows open(hid_t file, const std::string& name);

  hsize_t rows() const { return rows_; }
  /// Of a row.
  const std::vector<hsize_t>& shape() const { return shape_; }
  /// Numbers in a row.
  hsize_t width() const;

  /// Adds a row behind the last, from doubles or chars.
  void append(const std::vector<double>& values) { append(H5T_NATIVE_DOUBLE, values.data()); }
  void append(const std::vector<char>& values) { append(H5T_NATIVE_SCHAR, values.data()); }
  void read(hsize_t row, std::vector<double>& values) const;
  void read(hsize_t row, std::vector<char>& values) const;
  /// Drops the rows behind the first `rows`.
  void cut(hsize_t rows);

 private:
  Hdf5Rows(Hdf5Handle dataset, std::string name);
  void append(hid_t type, const void* values);
  void read(hsize_t row, hid_t type, void* values) const;
  Hdf5Handle place_of(hsize_t row) const;

  Hdf5Handle dataset_;
  std::string name_;
  hsize_t rows_ = 0;
  std::vector<hsize_t> shape_;
};

}  // namespace vocalis::io
