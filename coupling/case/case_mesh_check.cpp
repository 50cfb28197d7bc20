#include <algorithm>

#include "core/base/case_table.hpp"
#include "core/base/error.hpp"
#include "coupling/case/case.hpp"

namespace vocalis::coupling {

namespace {

using base::UserError;

bool is_in(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void check_name(const MeshReference& reference, const char* what, const std::vector<std::string>& names,
                const std::string& mesh) {
  if (is_in(reference.name, names)) return;
  throw UserError(reference.place + " must be the name of a group of " + what + " of the mesh " + mesh,
                  "\"" + reference.name + "\"",
                  names.empty() ? "the mesh has no named groups of " + std::string(what) +
                                      ": name them in Gmsh with Physical groups"
                                : base::did_you_mean(reference.name, names));
}

void check_vector(const MeshReference& reference, int dimension) {
  const std::size_t size = reference.components.size();
  const bool too_short = dimension == 3 && size == 2;
  const bool leaves_plane = dimension == 2 && size == 3 && reference.components[2] != 0;
  if (!too_short && !leaves_plane) return;
  throw UserError(reference.place + " must have " + std::to_string(dimension) + " components, as many as the mesh",
                  std::to_string(size), too_short ? "add the third component" : "leave out the third component");
}

}  // namespace

std::string own_mesh_table(const Case& config, const std::string& voice) {
  const auto own = config.acoustic_meshes.find(voice);
  return own == config.acoustic_meshes.end() ? "" : own->second.table;
}

bool sounds_on_the_case_mesh(const Case& config) { return config.acoustic_meshes.size() < config.acoustics.size(); }

void check_case_against_mesh_names(const Case& config, int dimension, const std::vector<std::string>& region_names,
                                   const std::vector<std::string>& group_names) {
  std::vector<std::string> named;
  for (const MeshReference& reference : config.references) {
    if (!reference.acoustic.empty()) continue;
    switch (reference.kind) {
      case MeshReference::Kind::region:
        check_name(reference, "cells", region_names, config.mesh.file);
        named.push_back(reference.name);
        break;
      case MeshReference::Kind::group:
        check_name(reference, "facets", group_names, config.mesh.file);
        break;
      case MeshReference::Kind::group_of_sound:
        if (sounds_on_the_case_mesh(config)) check_name(reference, "facets", group_names, config.mesh.file);
        break;
      case MeshReference::Kind::vector:
        check_vector(reference, dimension);
        break;
    }
  }
  for (const std::string& name : region_names) {
    if (is_in(name, named)) continue;
    throw UserError(config.file + ": the case must say what every region of the mesh " + config.mesh.file + " is",
                    "nothing about \"" + name + "\"", "add [[region]] with name = \"" + name + "\" and its kind");
  }
}

void check_acoustic_against_mesh_names(const Case& config, const std::string& acoustic,
                                       const std::vector<std::string>& group_names) {
  const AcousticMesh& own = config.acoustic_meshes.at(acoustic);
  for (const MeshReference& reference : config.references) {
    const bool is_of_sound = reference.kind == MeshReference::Kind::group_of_sound;
    if (is_of_sound || reference.acoustic == own.table) check_name(reference, "facets", group_names, own.mesh.file);
  }
}

}  // namespace vocalis::coupling
