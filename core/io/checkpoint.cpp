#include "core/io/checkpoint.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>

#include "core/base/error.hpp"
#include "core/base/first_rank.hpp"
#include "core/base/mpi.hpp"
#include "core/io/hdf5_handle.hpp"
#include "core/io/rank_parts.hpp"

namespace vocalis::io {

namespace {

using base::UserError;

constexpr int version = 1;
constexpr std::size_t first_block_size = 512;  // the smallest that HDF5 leaves free in front of its own bytes
constexpr const char* magic = "vocalis checkpoint";
constexpr const char* start_anew = "take an older checkpoint, or run the case again from its start";

/// What the first block says about the bytes behind it.
struct Seal {
  std::uint64_t bytes = 0;
  std::uint64_t checksum = 0;  ///< FNV-1a of 64 bits
};

/// Counts and sums all bytes behind the first block.
Seal seal_of(std::istream& file) {
  Seal seal{0, 0xcbf29ce484222325u};
  std::vector<char> buffer(1 << 20);
  file.seekg(first_block_size);
  while (file.read(buffer.data(), static_cast<std::streamsize>(buffer.size())), file.gcount() > 0) {
    for (std::streamsize i = 0; i < file.gcount(); ++i) {
      seal.checksum = (seal.checksum ^ static_cast<unsigned char>(buffer[i])) * 0x100000001b3u;
    }
    seal.bytes += file.gcount();
  }
  return seal;
}

std::string first_block(const Seal& seal) {
  std::string block = fmt::format("{} {}\nbytes {}\nchecksum {:016x}\n", magic, version, seal.bytes, seal.checksum);
  block.resize(first_block_size, '\n');
  return block;
}

[[noreturn]] void throw_not_written(const std::string& path, const std::string& reason) {
  throw UserError("the checkpoint " + path + " must be writable", reason,
                  "check that the folder exists, its permissions, and the free space of the disk");
}

/// Puts the first block in its place and waits until the disk has the file.
void write_seal(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string block = first_block(seal_of(file));
  const int descriptor = ::open(path.c_str(), O_WRONLY);
  if (descriptor < 0) throw_not_written(path, std::strerror(errno));
  const bool written = ::pwrite(descriptor, block.data(), block.size(), 0) == static_cast<ssize_t>(block.size()) &&
                       ::fsync(descriptor) == 0;
  const int number = errno;
  ::close(descriptor);
  if (!written) throw_not_written(path, std::strerror(number));
}

/// Gives the file its name; the folder is synchronised too, else the name may be lost with the power.
void rename_durably(const std::string& from, const std::string& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0) throw_not_written(to, std::strerror(errno));
  const std::string folder = std::filesystem::path(to).parent_path().string();
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

/// Throws UserError unless the file is a whole checkpoint of this version.
void check_seal(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw UserError("the checkpoint " + path + " must be readable", std::strerror(errno),
                    "check the path; a run writes its first checkpoint after output.checkpoint_steps steps");
  }
  std::string block(first_block_size, '\0');
  file.read(block.data(), first_block_size);
  block.resize(file.gcount());
  if (!block.starts_with(magic)) {
    throw UserError(path + " must be a checkpoint of Vocalis", "a file of another kind, or an empty one",
                    "give the checkpoint.h5 of a run folder");
  }
  std::istringstream words(block.substr(std::char_traits<char>::length(magic)));
  std::string found, word;
  words >> found;
  if (found != std::to_string(version)) {
    throw UserError(fmt::format("the checkpoint {} must have the format version {}", path, version),
                    "\"" + found + "\"",
                    "resume with the version of Vocalis that wrote it, or run the case again from its start");
  }
  Seal said;
  words >> word >> said.bytes >> word >> std::hex >> said.checksum;
  file.clear();
  const Seal seal = seal_of(file);
  if (!words || block != first_block(said) || said.bytes != seal.bytes) {
    throw UserError("the checkpoint " + path + " must be whole",
                    fmt::format("{} of {} bytes behind the first {}", seal.bytes, said.bytes, first_block_size),
                    std::string("the file was cut off or changed; ") + start_anew);
  }
  if (said.checksum != seal.checksum) {
    throw UserError("the checkpoint " + path + " must have the bytes that were written",
                    fmt::format("checksum {:016x} instead of {:016x}", seal.checksum, said.checksum),
                    std::string("the file is damaged; ") + start_anew);
  }
}

[[noreturn]] void throw_not_read(const std::string& path, const std::string& what, const std::string& reason) {
  throw UserError(
      "the checkpoint " + path + " must have " + what, reason,
      "resume with the case and the version of Vocalis that wrote it, or run the case again from its start");
}

template <class T>
auto gather(MPI_Comm comm, std::span<const T> values, std::vector<std::int64_t>& counts) {
  counts = base::gather_all(comm, static_cast<std::int64_t>(values.size()));
  return gather_to_first(comm, values);
}

}  // namespace

CheckpointWriter::CheckpointWriter(MPI_Comm comm, const std::string& path) : comm_(comm), path_(path) {}

void CheckpointWriter::add(const std::string& name, std::span<const double> values) {
  Gathered<double> gathered;
  gathered.values = gather(comm_, values, gathered.counts);
  [[maybe_unused]] const bool is_new = doubles_.try_emplace(name, std::move(gathered)).second;
  assert(is_new && !integers_.contains(name));
}

void CheckpointWriter::add(const std::string& name, std::span<const std::int64_t> values) {
  Gathered<std::int64_t> gathered;
  gathered.values = gather(comm_, values, gathered.counts);
  [[maybe_unused]] const bool is_new = integers_.try_emplace(name, std::move(gathered)).second;
  assert(is_new && !doubles_.contains(name));
}

void CheckpointWriter::add_text(const std::string& name, std::string_view text) {
  [[maybe_unused]] const bool is_new = texts_.try_emplace(name, text).second;
  assert(is_new);
}

void CheckpointWriter::write(const std::string& path) const {
  Hdf5Handle file = create_hdf5(path, first_block_size);
  const auto write_arrays = [&](const auto& arrays) {
    for (const auto& [name, array] : arrays) {
      const Hdf5Handle dataset = write_dataset(file, "/arrays/" + name, array.values, {array.values.size()});
      write_attribute(dataset, "counts", array.counts);
    }
  };
  write_arrays(doubles_);
  write_arrays(integers_);
  for (const auto& [name, text] : texts_) write_text(file, "/texts/" + name, text);
  write_attribute(file, "ranks", std::vector<std::int64_t>{base::size(comm_)});
  file.close_file();
}

void CheckpointWriter::commit() {
  base::on_first_rank(comm_, [this] {
    const QuietHdf5 quiet;
    const std::string temporary = path_ + ".part";
    try {
      write(temporary);
      write_seal(temporary);
      rename_durably(temporary, path_);
    } catch (const Hdf5Error& error) {
      std::remove(temporary.c_str());
      throw_not_written(path_, error.what());
    }
  });
}

CheckpointReader::CheckpointReader(MPI_Comm comm, const std::string& path) : comm_(comm), path_(path) {
  base::on_first_rank(comm, [this] {
    check_seal(path_);
    const QuietHdf5 quiet;
    std::int64_t ranks = 0;
    try {
      file_ = std::make_unique<Hdf5Handle>(open_hdf5(path_, H5F_ACC_RDONLY));
      ranks = read_integers_attribute(*file_, "ranks").at(0);
    } catch (const Hdf5Error& error) {
      throw_not_read(path_, "the number of ranks", error.what());
    }
    if (ranks != base::size(comm_)) {
      throw UserError("a run must be resumed on the number of ranks that wrote its checkpoint " + path_,
                      fmt::format("{} ranks, written by {}", base::size(comm_), ranks),
                      fmt::format("resume with --ranks {}", ranks));
    }
  });
}

CheckpointReader::~CheckpointReader() = default;
CheckpointReader::CheckpointReader(CheckpointReader&&) noexcept = default;
CheckpointReader& CheckpointReader::operator=(CheckpointReader&&) noexcept = default;

template <class T>
std::vector<T> CheckpointReader::read(const std::string& name) const {
  std::vector<T> all;
  std::vector<std::int64_t> counts;
  base::on_first_rank(comm_, [&] {
    const QuietHdf5 quiet;
    const std::string full_name = "/arrays/" + name;
    if (!has_object(*file_, full_name)) throw_not_read(path_, "the array \"" + name + "\"", "none of that name");
    try {
      all = read_dataset<T>(*file_, full_name);
      const Hdf5Handle dataset(H5Dopen2(*file_, full_name.c_str(), H5P_DEFAULT), H5Dclose, name + " was not opened");
      counts = read_integers_attribute(dataset, "counts");
    } catch (const Hdf5Error& error) {
      throw_not_read(path_, "the array \"" + name + "\"", error.what());
    }
    if (std::reduce(counts.begin(), counts.end()) != static_cast<std::int64_t>(all.size()) ||
        counts.size() != static_cast<std::size_t>(base::size(comm_))) {
      throw_not_read(path_, "a count for each rank's part of \"" + name + "\"", "counts that do not fit");
    }
  });
  return scatter_from_first(comm_, counts, all);
}

std::vector<double> CheckpointReader::doubles(const std::string& name) const { return read<double>(name); }

std::vector<std::int64_t> CheckpointReader::integers(const std::string& name) const { return read<std::int64_t>(name); }

std::string CheckpointReader::text(const std::string& name) const {
  std::vector<char> text;
  base::on_first_rank(comm_, [&] {
    const QuietHdf5 quiet;
    if (!has_object(*file_, "/texts/" + name)) throw_not_read(path_, "the text \"" + name + "\"", "none of that name");
    try {
      const std::string words = read_text(*file_, "/texts/" + name);
      text.assign(words.begin(), words.end());
    } catch (const Hdf5Error& error) {
      throw_not_read(path_, "the text \"" + name + "\"", error.what());
    }
  });
  base::broadcast(comm_, text);
  return {text.begin(), text.end()};
}

}  // namespace vocalis::io
