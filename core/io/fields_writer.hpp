#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/io/xdmf.hpp"
#include "core/mesh/mesh.hpp"

namespace vocalis::io {

/// A field at the vertices of the mesh.
struct NamedValues {
  std::string name;                ///< "velocity"
  int components = 1;              ///< 1, or the mesh's dimension
  std::span<const double> values;  ///< (vertices.num_local, components); ghosts are not read; NaN where undefined
};

/// Writes fields for ParaView and for h5py into a folder. Rank 0 alone has the files; vertices and cells are in their
/// global order.
///
/// fields.h5    /mesh/cells (cells, dimension + 1), /mesh/coordinates (vertices, 3) [m], /mesh/region (cells) with the
///              attribute region_names (separated by commas); groups /step_00000123 with the attribute time [s] and
///              a dataset for each field: (vertices), or (vertices, 3) with zeros behind the mesh's dimension
/// fields.xdmf  says the same to ParaView
/// Both are closed and whole after each call.
class FieldsWriter {
 public:
  /// Begins new files in a folder that exists; old ones are lost.
  /// parent   must outlive this
  /// Collective. Throws UserError on every rank if they cannot be written.
  FieldsWriter(MPI_Comm comm, const std::string& folder, const mesh::Mesh& parent);

  /// Goes on with the files of a run that ended: removes what it wrote after `last_step`. Without fields.h5 it begins
  /// new ones. Collective. Throws UserError on every rank if they belong to another mesh or are damaged.
  static FieldsWriter resume(MPI_Comm comm, const std::string& folder, const mesh::Mesh& parent, long last_step);

  /// Adds a step; one that is there already is replaced.
  /// time     [s]
  /// fields   the same names and components on every rank
  /// Collective. Throws UserError on every rank if the disk does not take it.
  void write(long step, double time, const std::vector<NamedValues>& fields);

 private:
  struct Step {
    long number = 0;
    std::string description;  ///< its element of fields.xdmf
  };
  struct Nothing {};
  FieldsWriter(Nothing, MPI_Comm comm, const std::string& folder, const mesh::Mesh& parent);
  std::string path(const char* name) const { return folder_ + "/" + name; }
  void read_steps(long last_step);
  void describe(long step, double time, const std::vector<XdmfField>& fields);
  void write_description() const;

  MPI_Comm comm_;
  std::string folder_;
  const mesh::Mesh* parent_;
  XdmfMesh shape_;
  std::vector<Step> steps_;  ///< rank 0 only; numbers rise
};

}  // namespace vocalis::io
