#pragma once

#include <cstdint>
#include <span>

#include "core/base/index_map.hpp"

/// PETSc's star forest, by its own name.
typedef struct _p_PetscSF* PetscSF;

namespace vocalis::base {

/// Moves values between the owner of an index and its ghosts; PETSc's star forest carries them, and this is the only
/// place that knows neighbours exist. Arrays have num_local rows of `block` numbers, owned first. All collective.
class Halo {
 public:
  Halo() = default;
  explicit Halo(const IndexMap& map);
  ~Halo();
  Halo(Halo&& other) noexcept;
  Halo& operator=(Halo&& other) noexcept;
  Halo(const Halo&) = delete;
  Halo& operator=(const Halo&) = delete;

  /// ghosts := owner's value
  void copy_to_ghosts(std::span<double> values, int block = 1) const;
  void copy_to_ghosts(std::span<std::int32_t> values) const;
  void copy_to_ghosts(std::span<std::int64_t> values) const;
  /// The same in two calls, between which the owned values may be read and the ghosts may not.
  void begin_copy_to_ghosts(std::span<double> values) const;
  void end_copy_to_ghosts(std::span<double> values) const;
  /// owner += ghosts; the ghosts' own values are left as they were, and mean nothing afterwards
  void add_to_owners(std::span<double> values, int block = 1) const;
  /// owner := smallest (largest) of its own and all ghosts' values
  void min_to_owners(std::span<std::int32_t> values) const;
  void max_to_owners(std::span<std::int32_t> values) const;

 private:
  void reduce(std::span<std::int32_t> values, MPI_Op operation) const;
  PetscSF forest_ = nullptr;
  std::int32_t num_owned_ = 0;
  std::int32_t num_ghosts_ = 0;
};

}  // namespace vocalis::base
