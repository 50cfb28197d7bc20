#include <filesystem>

#include "core/base/error.hpp"
#include "coupling/case/case_sections.hpp"

namespace vocalis::coupling {

namespace {

using base::UserError;

constexpr std::size_t kLongestList = 10000;  // of a parameter of the geometry

}  // namespace

MeshSettings read_mesh(MPI_Comm comm, base::Table& mesh, const Case& config) {
  MeshSettings settings;
  if (mesh.has("geometry") == mesh.has("file")) {
    throw UserError(mesh.place() + " needs one of geometry and file", mesh.has("file") ? "both" : "neither",
                    "write geometry = \"x.geo\", or file = \"x.msh\"");
  }
  settings.is_geometry = mesh.has("geometry");
  const std::string key = settings.is_geometry ? "geometry" : "file";
  settings.file = read_file_name(comm, mesh, key, config);
  if (settings.is_geometry && std::filesystem::path(settings.file).extension() != ".geo") {
    throw UserError(mesh.place(key) + " must be a Gmsh geometry, *.geo", "\"" + settings.file + "\"",
                    "write file = \"...\" for a mesh");
  }
  if (!settings.is_geometry) return settings;
  if (auto parameters = mesh.table_if("parameters")) {
    for (const std::string& name : parameters->keys()) {
      if (parameters->is_array(name)) {
        settings.parameters[name] = parameters->numbers(name, 1, kLongestList);
      } else {
        settings.parameters[name] = parameters->number(name, base::any_number);
      }
    }
  }
  return settings;
}

}  // namespace vocalis::coupling
