#pragma once

#include <hdf5.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace vocalis::io {

/// HDF5 said no; whoever knows the file tells the user. Never leaves this folder.
class Hdf5Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Keeps HDF5 from printing its own errors while it lives.
class QuietHdf5 {
 public:
  QuietHdf5();
  ~QuietHdf5();
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// One HDF5 object on one rank, closed at the end of its scope. All functions below: one rank, throw Hdf5Error.
class Hdf5Handle {
 public:
  /// close  H5Fclose, H5Dclose and so on
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what);
  ~Hdf5Handle();
  Hdf5Handle(Hdf5Handle&& other) noexcept;
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept;
  operator hid_t() const { return id_; }
  /// Hands all bytes of a file to the operating system.
  void flush_file();
  /// Flushes and closes a file now, so that a failure is known.
  void close_file();

 private:
  hid_t id_ = H5I_INVALID_HID;
  herr_t (*close_)(hid_t) = nullptr;
};

/// Opens or makes a file without locking it, so that ParaView may read it meanwhile.
Hdf5Handle open_hdf5(const std::string& path, unsigned mode);
Hdf5Handle create_hdf5(const std::string& path, std::uint64_t first_block = 0);

/// A group that has no name yet, and its name. It is lost unless it gets one.
Hdf5Handle create_nameless_group(hid_t file);
void name_group(hid_t group, hid_t file, const std::string& name);

/// Writes a whole dataset of doubles, int64 or int32. Groups in the name are made.
template <class T>
Hdf5Handle write_dataset(hid_t file, const std::string& name, const std::vector<T>& values,
                         const std::vector<hsize_t>& shape);

/// Reads a whole dataset; its kind must be that of T.
template <class T>
std::vector<T> read_dataset(hid_t file, const std::string& name);

void write_text(hid_t file, const std::string& name, const std::string& text);
std::string read_text(hid_t file, const std::string& name);

void write_attribute(hid_t object, const std::string& name, const std::vector<std::int64_t>& values);
void write_attribute(hid_t object, const std::string& name, const std::string& text);
void write_attribute(hid_t object, const std::string& name, double value);
std::vector<std::int64_t> read_integers_attribute(hid_t object, const std::string& name);
double read_real_attribute(hid_t object, const std::string& name);

bool has_object(hid_t file, const std::string& name);
void remove_object(hid_t file, const std::string& name);
/// What a file or group contains, sorted.
std::vector<std::string> names_in(hid_t group);
int num_dimensions(hid_t group, const std::string& dataset);

}  // namespace vocalis::io
