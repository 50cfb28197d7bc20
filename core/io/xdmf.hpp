#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vocalis::io {

/// What an XDMF file says about the mesh of fields.h5.
struct XdmfMesh {
  int dimension = 2;
  std::int64_t num_cells = 0;
  std::int64_t num_vertices = 0;
};

/// A field of one step.
struct XdmfField {
  std::string name;
  int components = 1;  ///< 1 or 3
};

/// The group of a step in fields.h5: "step_00000123".
std::string step_group(long step);

/// The element of one step: the mesh, the region of each cell, the fields.
/// time   [s]
std::string xdmf_step(const XdmfMesh& mesh, long step, double time, const std::vector<XdmfField>& fields);

/// The whole file: a series of steps, or without any the mesh alone.
std::string xdmf_file(const XdmfMesh& mesh, const std::vector<std::string>& steps);

}  // namespace vocalis::io
