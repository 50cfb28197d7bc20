#include "core/io/hdf5_rows.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace vocalis::io {

namespace {

constexpr hsize_t largest_chunk = 1 << 17;     // [numbers]
constexpr hsize_t rows_of_short_chunks = 256;  // where a row is one number
constexpr unsigned compression = 1;            // of gzip: more takes longer than it saves, see docs/flow-record.md

void require(bool good, const std::string& what) {
  if (!good) throw Hdf5Error(what);
}

std::vector<hsize_t> with_rows(hsize_t rows, const std::vector<hsize_t>& shape) {
  std::vector<hsize_t> result = {rows};
  result.insert(result.end(), shape.begin(), shape.end());
  return result;
}

/// One row, or a part of its vertices if it is long.
std::vector<hsize_t> chunk_of(std::vector<hsize_t> shape) {
  if (shape.empty()) return {rows_of_short_chunks};
  const hsize_t width = shape.size() > 1 ? shape[1] : 1;
  shape[0] = std::clamp<hsize_t>(shape[0], 1, largest_chunk / width);
  return with_rows(1, shape);
}

}  // namespace

Hdf5Rows Hdf5Rows::create(hid_t file, const std::string& name, hid_t type, const std::vector<hsize_t>& shape) {
  const std::vector<hsize_t> now = with_rows(0, shape), most = with_rows(H5S_UNLIMITED, shape), chunk = chunk_of(shape);
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(now.size()), now.data(), most.data()), H5Sclose,
                         "a shape was not made");
  const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "properties were not made");
  require(H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()) >= 0, "a dataset cannot grow");
  // A chunk of several rows is written anew in its place; compressed it might move over the bytes of another one.
  if (!shape.empty()) {
    require(
        H5Pset_shuffle(creation) >= 0 && H5Pset_deflate(creation, compression) >= 0 && H5Pset_fletcher32(creation) >= 0,
        "this HDF5 cannot compress");
  }
  return {{H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose,
           name + " was not made"},
          name};
}

Hdf5Rows Hdf5Rows::open(hid_t file, const std::string& name) {
  return {{H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, name + " is missing"}, name};
}

Hdf5Rows::Hdf5Rows(Hdf5Handle dataset, std::string name) : dataset_(std::move(dataset)), name_(std::move(name)) {
  const Hdf5Handle space(H5Dget_space(dataset_), H5Sclose, name_ + " has no shape");
  const int dimensions = H5Sget_simple_extent_ndims(space);
  require(dimensions > 0, name_ + " has no rows");
  std::vector<hsize_t> extent(dimensions);
  H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  rows_ = extent[0];
  shape_.assign(extent.begin() + 1, extent.end());
}

hsize_t Hdf5Rows::width() const {
  return std::accumulate(shape_.begin(), shape_.end(), hsize_t{1}, std::multiplies<>());
}

Hdf5Handle Hdf5Rows::place_of(hsize_t row) const {
  Hdf5Handle space(H5Dget_space(dataset_), H5Sclose, name_ + " has no shape");
  std::vector<hsize_t> start(shape_.size() + 1, 0);
  start[0] = row;
  const std::vector<hsize_t> count = with_rows(1, shape_);
  require(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) >= 0,
          name_ + " has no such row");
  return space;
}

void Hdf5Rows::append(hid_t type, const void* values) {
  cut(rows_ + 1);
  const hsize_t numbers = width();
  const Hdf5Handle memory(H5Screate_simple(1, &numbers, nullptr), H5Sclose, "a shape was not made");
  require(H5Dwrite(dataset_, type, memory, place_of(rows_ - 1), H5P_DEFAULT, values) >= 0, name_ + " was not written");
}

void Hdf5Rows::read(hsize_t row, hid_t type, void* values) const {
  const hsize_t numbers = width();
  const Hdf5Handle memory(H5Screate_simple(1, &numbers, nullptr), H5Sclose, "a shape was not made");
  require(H5Dread(dataset_, type, memory, place_of(row), H5P_DEFAULT, values) >= 0, name_ + " was not read");
}

void Hdf5Rows::read(hsize_t row, std::vector<double>& values) const {
  values.resize(width());
  read(row, H5T_NATIVE_DOUBLE, values.data());
}

void Hdf5Rows::read(hsize_t row, std::vector<char>& values) const {
  values.resize(width());
  read(row, H5T_NATIVE_SCHAR, values.data());
}

void Hdf5Rows::cut(hsize_t rows) {
  const std::vector<hsize_t> extent = with_rows(rows, shape_);
  require(H5Dset_extent(dataset_, extent.data()) >= 0, name_ + " cannot have other rows");
  rows_ = rows;
}

}  // namespace vocalis::io
