#pragma once

#include <petscsystypes.h>

#include <span>
#include <vector>

#include "core/base/index_map.hpp"

namespace vocalis::la {

/// Where several distributed fields stand in one system of equations. A rank's rows are contiguous: first all of its
/// owned rows of field 0 (components of one index side by side), then field 1, ...
class SystemLayout {
 public:
  struct Part {
    const base::IndexMap* map;
    int components;
  };

  SystemLayout() = default;
  /// The index maps must outlive the layout. Collective.
  SystemLayout(MPI_Comm comm, std::vector<Part> parts);

  MPI_Comm comm() const { return comm_; }
  PetscInt num_owned() const { return num_owned_; }
  PetscInt offset() const { return offset_; }
  /// Global row of a component of a local index (owned or ghost) of a field.
  PetscInt global(int field, std::int32_t local, int component) const {
    const auto& rows = first_global_[field];
    return rows[local] + component;
  }
  /// Position of an owned index's first component in the rank's own part of a vector.
  PetscInt start(int field) const { return start_[field]; }
  int components(int field) const { return parts_[field].components; }

  /// Owned rows of one field, from and to a distributed vector's owned values.
  void copy_owned(int field, const double* system_values, std::span<double> field_values) const;
  void copy_owned_to_system(int field, std::span<const double> field_values, double* system_values) const;

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
  std::vector<Part> parts_;
  std::vector<PetscInt> start_;
  std::vector<std::vector<PetscInt>> first_global_;
  PetscInt num_owned_ = 0;
  PetscInt offset_ = 0;
};

}  // namespace vocalis::la
