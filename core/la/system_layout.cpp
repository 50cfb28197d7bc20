#include "core/la/system_layout.hpp"

#include <algorithm>

#include "core/base/mpi.hpp"

namespace vocalis::la {

SystemLayout::SystemLayout(MPI_Comm comm, std::vector<Part> parts) : comm_(comm), parts_(std::move(parts)) {
  for (const Part& part : parts_) {
    start_.push_back(num_owned_);
    num_owned_ += part.map->num_owned * part.components;
  }
  offset_ = static_cast<PetscInt>(base::contiguous_index_map(comm, num_owned_).offset);
  for (std::size_t field = 0; field < parts_.size(); ++field) {
    const auto& [map, components] = parts_[field];
    const auto first_rows = base::gather_all(comm, static_cast<std::int32_t>(offset_ + start_[field]));
    const auto map_offsets = base::gather_all(comm, map->offset);
    auto& rows = first_global_.emplace_back(map->num_local());
    for (std::int32_t i = 0; i < map->num_owned; ++i) rows[i] = offset_ + start_[field] + i * components;
    for (std::int32_t g = 0; g < map->num_ghosts(); ++g) {
      const int owner = map->ghost_owner[g];
      const auto index_there = static_cast<PetscInt>(map->ghost_global[g] - map_offsets[owner]);
      rows[map->num_owned + g] = first_rows[owner] + index_there * components;
    }
  }
}

void SystemLayout::copy_owned(int field, const double* system_values, std::span<double> field_values) const {
  std::copy_n(system_values + start_[field], parts_[field].map->num_owned * parts_[field].components,
              field_values.begin());
}

void SystemLayout::copy_owned_to_system(int field, std::span<const double> field_values, double* system_values) const {
  std::copy_n(field_values.begin(), parts_[field].map->num_owned * parts_[field].components,
              system_values + start_[field]);
}

}  // namespace vocalis::la
