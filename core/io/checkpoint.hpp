#pragma once

#include <mpi.h>

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vocalis::io {

class Hdf5Handle;

/// Collects named arrays and texts and writes them as one file, whole or not at all: the old file of that name stays
/// until the new one is on the disk. An HDF5 file behind a first block of 512 bytes that says the version, the number
/// of bytes and their checksum; /arrays/NAME with the attribute `counts` (numbers of each rank), /texts/NAME.
class CheckpointWriter {
 public:
  CheckpointWriter(MPI_Comm comm, const std::string& path);

  /// Adds this rank's part of an array; it may be empty, and the same name is given once. Copies. Collective.
  void add(const std::string& name, std::span<const double> values);
  void add(const std::string& name, std::span<const std::int64_t> values);

  /// Adds a text; rank 0's counts. Not collective.
  void add_text(const std::string& name, std::string_view text);

  /// Writes a temporary file beside `path`, waits for the disk, and gives it its name. The last call.
  /// Collective. Throws UserError on every rank if the disk does not take it; the old file is then untouched.
  void commit();

 private:
  template <class T>
  struct Gathered {
    std::vector<T> values;             ///< of all ranks, in rank order
    std::vector<std::int64_t> counts;  ///< of each rank
  };
  void write(const std::string& path) const;

  MPI_Comm comm_;
  std::string path_;
  std::map<std::string, Gathered<double>> doubles_;  ///< rank 0 only, as all below
  std::map<std::string, Gathered<std::int64_t>> integers_;
  std::map<std::string, std::string> texts_;
};

/// Reads what a `CheckpointWriter` wrote on the same number of ranks. Every byte is compared with the checksum first.
class CheckpointReader {
 public:
  /// Collective. Throws UserError on every rank if the file is missing, is no checkpoint, is of another version, cut
  /// off or damaged, or was written by another number of ranks.
  CheckpointReader(MPI_Comm comm, const std::string& path);
  ~CheckpointReader();
  CheckpointReader(CheckpointReader&&) noexcept;
  CheckpointReader& operator=(CheckpointReader&&) noexcept;

  /// This rank's part of an array. Collective. Throws UserError on every rank if the file has no such array.
  std::vector<double> doubles(const std::string& name) const;
  std::vector<std::int64_t> integers(const std::string& name) const;

  /// A text, on every rank. Collective. Throws UserError on every rank if the file has no such text.
  std::string text(const std::string& name) const;

 private:
  template <class T>
  std::vector<T> read(const std::string& name) const;

  MPI_Comm comm_;
  std::string path_;
  std::unique_ptr<Hdf5Handle> file_;  ///< rank 0 only
};

}  // namespace vocalis::io
