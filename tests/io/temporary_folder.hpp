#pragma once

#include <mpi.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/base/mpi.hpp"

namespace vocalis::io {

/// A folder that rank 0 makes, every rank knows, and that goes with the object. Collective.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::vector<char> name;
    if (base::rank(MPI_COMM_WORLD) == 0) {
      std::string pattern = (std::filesystem::temp_directory_path() / "vocalis-test-XXXXXX").string();
      path_ = mkdtemp(pattern.data());
      name.assign(path_.begin(), path_.end());
    }
    base::broadcast(MPI_COMM_WORLD, name);
    path_.assign(name.begin(), name.end());
  }
  ~TemporaryFolder() {
    MPI_Barrier(MPI_COMM_WORLD);
    std::error_code code;
    if (base::rank(MPI_COMM_WORLD) == 0) std::filesystem::remove_all(path_, code);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }

  /// Writes a small file on rank 0 and returns its path. Collective.
  std::string write(const std::string& name, const std::string& text) const {
    if (base::rank(MPI_COMM_WORLD) == 0) std::ofstream(file(name), std::ios::binary) << text;
    MPI_Barrier(MPI_COMM_WORLD);
    return file(name);
  }

 private:
  std::string path_;
};

}  // namespace vocalis::io
