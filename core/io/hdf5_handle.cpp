#include "core/io/hdf5_handle.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace vocalis::io {

namespace {

void require(bool good, const std::string& what) {
  if (!good) throw Hdf5Error(what);
}

template <class T>
hid_t native_type() {
  if constexpr (std::is_same_v<T, double>) {
    return H5T_NATIVE_DOUBLE;
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    return H5T_NATIVE_INT64;
  } else {
    static_assert(std::is_same_v<T, std::int32_t>);
    return H5T_NATIVE_INT32;
  }
}

Hdf5Handle space_of(const std::vector<hsize_t>& shape) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose, "a scalar was not made"};
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose, "a shape was not made"};
}

/// Fixed length, filled up with zeros; HDF5 has no text of length zero.
Hdf5Handle type_of_text(std::size_t length) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "a type was not made");
  require(H5Tset_size(type, std::max<std::size_t>(1, length)) >= 0, "a text is too long");
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

Hdf5Handle create_dataset(hid_t file, const std::string& name, hid_t type, hid_t space) {
  const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "properties were not made");
  H5Pset_create_intermediate_group(links, 1);
  return {H5Dcreate2(file, name.c_str(), type, space, links, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
          name + " was not made"};
}

Hdf5Handle open_dataset(hid_t file, const std::string& name) {
  return {H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, name + " was not opened"};
}

Hdf5Handle unlocked() {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "properties were not made");
  H5Pset_file_locking(access, 0, 1);
  return access;
}

void write_attribute(hid_t object, const std::string& name, hid_t type, hid_t space, const void* values) {
  const Hdf5Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                             "the attribute " + name + " was not made");
  require(H5Awrite(attribute, type, values) >= 0, "the attribute " + name + " was not written");
}

Hdf5Handle open_attribute(hid_t object, const std::string& name) {
  return {H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "the attribute " + name + " is missing"};
}

herr_t add_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

}  // namespace

QuietHdf5::QuietHdf5() {
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietHdf5::~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

Hdf5Handle::Hdf5Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
  require(id >= 0, what);
}

Hdf5Handle::~Hdf5Handle() {
  if (id_ >= 0) close_(id_);
}

Hdf5Handle::Hdf5Handle(Hdf5Handle&& other) noexcept
    : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}

Hdf5Handle& Hdf5Handle::operator=(Hdf5Handle&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}

void Hdf5Handle::flush_file() { require(H5Fflush(id_, H5F_SCOPE_GLOBAL) >= 0, "the disk did not take all bytes"); }

void Hdf5Handle::close_file() {
  flush_file();
  require(close_(std::exchange(id_, H5I_INVALID_HID)) >= 0, "the file could not be closed");
}

Hdf5Handle open_hdf5(const std::string& path, unsigned mode) {
  return {H5Fopen(path.c_str(), mode, unlocked()), H5Fclose, "it is no whole HDF5 file"};
}

Hdf5Handle create_hdf5(const std::string& path, std::uint64_t first_block) {
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "properties were not made");
  require(H5Pset_userblock(creation, first_block) >= 0, "the first block was not made");
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, unlocked()), H5Fclose, "the file was not made"};
}

Hdf5Handle create_nameless_group(hid_t file) {
  return {H5Gcreate_anon(file, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "a group was not made"};
}

void name_group(hid_t group, hid_t file, const std::string& name) {
  require(H5Olink(group, file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT) >= 0, name + " was not named");
}

template <class T>
Hdf5Handle write_dataset(hid_t file, const std::string& name, const std::vector<T>& values,
                         const std::vector<hsize_t>& shape) {
  Hdf5Handle dataset = create_dataset(file, name, native_type<T>(), space_of(shape));
  if (!values.empty()) {
    require(H5Dwrite(dataset, native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0,
            name + " was not written");
  }
  return dataset;
}

template <class T>
std::vector<T> read_dataset(hid_t file, const std::string& name) {
  const Hdf5Handle dataset = open_dataset(file, name);
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose, name + " has no type");
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose, name + " has no shape");
  require(H5Tget_class(type) == (std::is_same_v<T, double> ? H5T_FLOAT : H5T_INTEGER),
          name + " has numbers of another kind");
  std::vector<T> values(H5Sget_simple_extent_npoints(space));
  if (!values.empty()) {
    require(H5Dread(dataset, native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0,
            name + " was not read");
  }
  return values;
}

template Hdf5Handle write_dataset(hid_t, const std::string&, const std::vector<double>&, const std::vector<hsize_t>&);
template Hdf5Handle write_dataset(hid_t, const std::string&, const std::vector<std::int64_t>&,
                                  const std::vector<hsize_t>&);
template Hdf5Handle write_dataset(hid_t, const std::string&, const std::vector<std::int32_t>&,
                                  const std::vector<hsize_t>&);
template std::vector<double> read_dataset(hid_t, const std::string&);
template std::vector<std::int64_t> read_dataset(hid_t, const std::string&);
template std::vector<std::int32_t> read_dataset(hid_t, const std::string&);

void write_text(hid_t file, const std::string& name, const std::string& text) {
  const Hdf5Handle type = type_of_text(text.size());
  const Hdf5Handle dataset = create_dataset(file, name, type, space_of({}));
  require(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) >= 0, name + " was not written");
}

std::string read_text(hid_t file, const std::string& name) {
  const Hdf5Handle dataset = open_dataset(file, name);
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose, name + " has no type");
  require(H5Tget_class(type) == H5T_STRING, name + " is no text");
  std::string text(H5Tget_size(type), '\0');
  require(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) >= 0, name + " was not read");
  while (!text.empty() && text.back() == '\0') text.pop_back();
  return text;
}

void write_attribute(hid_t object, const std::string& name, const std::vector<std::int64_t>& values) {
  write_attribute(object, name, H5T_NATIVE_INT64, space_of({values.size()}), values.data());
}

void write_attribute(hid_t object, const std::string& name, const std::string& text) {
  write_attribute(object, name, type_of_text(text.size()), space_of({}), text.c_str());
}

void write_attribute(hid_t object, const std::string& name, double value) {
  write_attribute(object, name, H5T_NATIVE_DOUBLE, space_of({}), &value);
}

std::vector<std::int64_t> read_integers_attribute(hid_t object, const std::string& name) {
  const Hdf5Handle attribute = open_attribute(object, name);
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose, "the attribute " + name + " has no shape");
  std::vector<std::int64_t> values(H5Sget_simple_extent_npoints(space));
  require(H5Aread(attribute, H5T_NATIVE_INT64, values.data()) >= 0, "the attribute " + name + " was not read");
  return values;
}

double read_real_attribute(hid_t object, const std::string& name) {
  double value = 0;
  require(H5Aread(open_attribute(object, name), H5T_NATIVE_DOUBLE, &value) >= 0,
          "the attribute " + name + " was not read");
  return value;
}

bool has_object(hid_t file, const std::string& name) {
  for (std::size_t slash = name.find('/', 1);; slash = name.find('/', slash + 1)) {
    if (H5Lexists(file, name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    if (slash == std::string::npos) return true;
  }
}

void remove_object(hid_t file, const std::string& name) {
  require(H5Ldelete(file, name.c_str(), H5P_DEFAULT) >= 0, name + " was not removed");
}

std::vector<std::string> names_in(hid_t group) {
  std::vector<std::string> names;
  require(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, add_name, &names) >= 0, "the file was not listed");
  return names;
}

int num_dimensions(hid_t group, const std::string& name) {
  const Hdf5Handle dataset = open_dataset(group, name);
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose, name + " has no shape");
  return H5Sget_simple_extent_ndims(space);
}

}  // namespace vocalis::io
