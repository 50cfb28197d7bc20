#include "core/base/file_text.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"

namespace vocalis::base {

namespace {

constexpr std::uintmax_t largest_size = 16u << 20;

/// An empty string, or why the file cannot be read.
std::string read_here(const std::string& path, std::vector<char>& text) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) return "it is a folder";
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::strerror(errno);
  if (std::filesystem::file_size(path, code) > largest_size && !code) return "it is larger than 16 MB";
  text.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  if (file.bad()) return "reading stopped half-way";
  return {};
}

}  // namespace

std::string read_text(MPI_Comm comm, const std::string& path, const std::string& what) {
  std::vector<char> text;
  std::vector<char> problem;
  if (rank(comm) == 0) {
    const std::string words = read_here(path, text);
    problem.assign(words.begin(), words.end());
  }
  broadcast(comm, problem);
  if (!problem.empty()) {
    throw UserError(path + ": the " + what + " cannot be read", std::string(problem.begin(), problem.end()),
                    "check the path and the permissions");
  }
  broadcast(comm, text);
  return {text.begin(), text.end()};
}

}  // namespace vocalis::base
