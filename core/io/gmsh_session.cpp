#include "core/io/gmsh_session.hpp"

#include <fmt/format.h>
#include <gmsh.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <vector>

#include "core/base/case_table.hpp"
#include "core/base/error.hpp"
#include "core/io/geo_parameters.hpp"

namespace vocalis::io {

namespace {

bool is_geometry(const std::string& path) { return std::filesystem::path(path).extension() == ".geo"; }

std::string key_of(const std::string& path) { return is_geometry(path) ? "mesh.geometry" : "mesh.file"; }

void check_file(const std::string& path) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) {
    throw base::UserError("the mesh must be a file", path + " is a folder", "give a file as " + key_of(path));
  }
  if (!std::ifstream(path)) {
    throw base::UserError("the mesh file must be readable", path,
                          "check " + key_of(path) + ", a path from the case file");
  }
}

/// Gmsh leaves out, without a word, a last line that does not end.
void check_last_lines(const std::string& path) {
  for (const std::string& name : geo_files(path)) {
    std::ifstream file(name, std::ios::binary);
    file.seekg(-1, std::ios::end);
    if (!file || file.get() == '\n') continue;
    throw base::UserError(name + ": the last line must end with a line break, or Gmsh does not see it", "none",
                          "add an empty line to the file");
  }
}

void check_parameters(const std::string& path, const GeoValues& parameters) {
  if (parameters.empty()) return;
  if (!is_geometry(path)) {
    throw base::UserError(path + ": only a .geo file has parameters", "mesh.parameters." + parameters.begin()->first,
                          "remove [mesh.parameters], or give the geometry instead of the mesh");
  }
  const std::vector<std::string> names = geo_parameters(path);
  for (const auto& [name, value] : parameters) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    throw base::UserError(path + ": a parameter must be one that the geometry gives in DefineConstant",
                          "mesh.parameters." + name, base::did_you_mean(name, names));
  }
}

std::string assignment(const std::string& name, const GeoValues::mapped_type& value) {
  if (const double* number = std::get_if<double>(&value)) return fmt::format("{} = {:.17g};\n", name, *number);
  return fmt::format("{}() = {{{:.17g}}};\n", name, fmt::join(std::get<std::vector<double>>(value), ", "));
}

/// A file of assignments that goes as soon as its scope ends.
class Prelude {
 public:
  explicit Prelude(const GeoValues& parameters) {
    std::string name = (std::filesystem::temp_directory_path() / "vocalis-XXXXXX.geo").string();
    const int file = mkstemps(name.data(), 4);
    if (file < 0) throw base::UserError("the temporary folder must be writable", name, "set TMPDIR to another folder");
    close(file);
    path_ = name;
    std::ofstream stream(path_);
    for (const auto& [key, value] : parameters) stream << assignment(key, value);
  }
  ~Prelude() { unlink(path_.c_str()); }
  Prelude(const Prelude&) = delete;
  Prelude& operator=(const Prelude&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Gmsh's types of the elements of one dimension.
std::vector<int> element_types(int dimension) {
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, dimension);
  return types;
}

bool has_cells() { return !element_types(2).empty() || !element_types(3).empty(); }

bool has_second_order_cells() {
  const std::vector<int> triangles = element_types(2), tetrahedra = element_types(3);
  return std::count(triangles.begin(), triangles.end(), 9) + std::count(tetrahedra.begin(), tetrahedra.end(), 11) > 0;
}

void throw_logged_errors(const std::string& path) {
  std::vector<std::string> lines;
  gmsh::logger::get(lines);
  std::string errors;
  for (const std::string& line : lines) {
    if (line.starts_with("Error: ")) errors += (errors.empty() ? "" : "\n         ") + line.substr(7);
  }
  if (errors.empty()) return;
  throw base::UserError(path + ": Gmsh must read and mesh the file without errors", errors,
                        "correct the file, or the values in [mesh.parameters]; `gmsh " + path + "` shows the geometry");
}

/// The log would outlive the library's end.
void close_library() {
  gmsh::logger::stop();
  gmsh::finalize();
}

}  // namespace

GmshSession::GmshSession(const std::string& path, const GeoValues& parameters, bool curved) {
  check_file(path);
  if (is_geometry(path)) check_last_lines(path);
  check_parameters(path, parameters);
  gmsh::initialize(0, nullptr, false);
  try {
    open(path, parameters, curved);
  } catch (...) {
    close_library();
    throw;
  }
}

GmshSession::~GmshSession() { close_library(); }

void GmshSession::open(const std::string& path, const GeoValues& parameters, bool curved) {
  gmsh::option::setNumber("General.Terminal", 0);
  // Threads may finish in any order, and the mesh must be the same each time.
  gmsh::option::setNumber("General.NumThreads", 1);
  // Gmsh must not throw: its parser would keep the rest of a broken file for the next one. Errors are in its log.
  gmsh::option::setNumber("General.AbortOnError", 0);
  gmsh::logger::start();
  if (is_geometry(path)) {
    // Assignments before the geometry go before its DefineConstant. Gmsh's own -setnumber outlives the session.
    const Prelude prelude(parameters);
    gmsh::open(prelude.path());
    gmsh::merge(path);
  } else {
    gmsh::open(path);
  }
  throw_logged_errors(path);
  const bool is_drawn = is_geometry(path) || !has_cells();
  if (!has_cells()) {
    gmsh::model::mesh::generate(gmsh::model::getDimension());
    throw_logged_errors(path);
  }
  // Anew, Gmsh would lose the middles of a second-order mesh that the geometry merges.
  if (curved && is_drawn && !has_second_order_cells()) {
    gmsh::model::mesh::setOrder(2);
    throw_logged_errors(path);
  }
}

}  // namespace vocalis::io
