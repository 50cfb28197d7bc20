#include "coupling/case/case_sections.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"

namespace vocalis::coupling {

namespace {

using base::UserError;

std::array<double, 3> padded(const std::vector<double>& values) {
  std::array<double, 3> result = {0, 0, 0};
  std::copy(values.begin(), values.end(), result.begin());
  return result;
}

/// Whether rank 0 can read a file, on every rank. Collective.
bool is_readable(MPI_Comm comm, const std::string& path) {
  int readable = 0;
  if (base::rank(comm) == 0) {
    std::error_code code;
    readable = std::filesystem::is_regular_file(path, code) && access(path.c_str(), R_OK) == 0 ? 1 : 0;
  }
  MPI_Bcast(&readable, 1, MPI_INT, 0, comm);
  return readable == 1;
}

void check_plain(const base::Table& table, const std::string& key, const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
  if (!std::all_of(name.begin(), name.end(), plain)) {
    throw UserError(table.place(key) + " may hold letters, digits, _ and - only", "\"" + name + "\"",
                    "files and columns are named after it: choose a plain name");
  }
}

}  // namespace

std::string read_file_name(MPI_Comm comm, base::Table& table, const std::string& key, const Case& config) {
  const std::string written = table.text(key);
  const std::filesystem::path path =
      std::filesystem::absolute(std::filesystem::path(config.file).parent_path() / written).lexically_normal();
  if (!is_readable(comm, path.string())) {
    throw UserError(table.place(key) + " must be a file that can be read",
                    "\"" + written + "\" (" + path.string() + ")",
                    "check the name; it is looked for beside the case file");
  }
  table.resolve_text(key, path.string());
  return path.string();
}

std::string read_plain_name(base::Table& table, const std::string& key) {
  const std::string name = table.text(key);
  check_plain(table, key, name);
  return name;
}

std::string read_plain_name_or(base::Table& table, const std::string& key, const std::string& fallback) {
  const std::string name = table.text_or(key, fallback);
  check_plain(table, key, name);
  return name;
}

std::array<double, 3> read_vector(base::Table& table, const std::string& key, const std::string& unit, Case& config) {
  const std::vector<double> values = table.numbers(key, 2, 3, unit);
  config.references.push_back({MeshReference::Kind::vector, table.place(key), key, values});
  return padded(values);
}

std::array<double, 3> read_vector_or(base::Table& table, const std::string& key, const std::array<double, 3>& fallback,
                                     const std::string& unit, Case& config) {
  if (table.has(key)) return read_vector(table, key, unit, config);
  return padded(table.numbers_or(key, {fallback.begin(), fallback.end()}, 2, 3, unit));
}

std::string read_group(base::Table& table, Case& config, const std::string& key) {
  const std::string name = table.text(key);
  config.references.push_back({MeshReference::Kind::group, table.place(key), name, {}});
  return name;
}

std::vector<std::string> read_groups(base::Table& table, Case& config, const std::string& key) {
  const std::vector<std::string> names = table.texts(key);
  for (const std::string& name : names) {
    config.references.push_back({MeshReference::Kind::group, table.place(key), name, {}});
  }
  return names;
}

void reject_duplicates(const base::Table& root, const std::string& what, const std::vector<std::string>& names,
                       const std::string& key) {
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (seen.insert(name).second) continue;
    throw UserError(root.place() + ": every " + what + " needs a " + key + " of its own", "\"" + name + "\" twice",
                    key == "name" ? "rename or merge them" : "merge them, or leave one out");
  }
}

}  // namespace vocalis::coupling
