#include "core/base/halo.hpp"

#include <petscsf.h>

#include <cassert>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"

namespace vocalis::base {

namespace {

/// A unit of `block` doubles, freed at the end of the scope.
class BlockType {
 public:
  explicit BlockType(int block) {
    if (block == 1) return;
    MPI_Type_contiguous(block, MPI_DOUBLE, &type_);
    MPI_Type_commit(&type_);
  }
  ~BlockType() {
    if (type_ != MPI_DOUBLE) MPI_Type_free(&type_);
  }
  BlockType(const BlockType&) = delete;
  BlockType& operator=(const BlockType&) = delete;
  MPI_Datatype get() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DOUBLE;
};

}  // namespace

Halo::Halo(const IndexMap& map) : num_owned_(map.num_owned), num_ghosts_(map.num_ghosts()) {
  const std::vector<std::int64_t> offsets = gather_all(map.comm, map.offset);
  std::vector<PetscSFNode> roots(num_ghosts_);
  for (std::int32_t g = 0; g < num_ghosts_; ++g) {
    roots[g].rank = map.ghost_owner[g];
    roots[g].index = static_cast<PetscInt>(map.ghost_global[g] - offsets[map.ghost_owner[g]]);
  }
  check(PetscSFCreate(map.comm, &forest_));
  check(PetscSFSetGraph(forest_, num_owned_, num_ghosts_, nullptr, PETSC_COPY_VALUES, roots.data(), PETSC_COPY_VALUES));
  check(PetscSFSetUp(forest_));
}

Halo::~Halo() {
  if (forest_) PetscSFDestroy(&forest_);
}

Halo::Halo(Halo&& other) noexcept
    : forest_(std::exchange(other.forest_, nullptr)), num_owned_(other.num_owned_), num_ghosts_(other.num_ghosts_) {}

Halo& Halo::operator=(Halo&& other) noexcept {
  std::swap(forest_, other.forest_);
  num_owned_ = other.num_owned_;
  num_ghosts_ = other.num_ghosts_;
  return *this;
}

void Halo::copy_to_ghosts(std::span<double> values, int block) const {
  assert(values.size() == static_cast<std::size_t>(num_owned_ + num_ghosts_) * block);
  const BlockType unit(block);
  double* ghosts = values.data() + static_cast<std::size_t>(num_owned_) * block;
  check(PetscSFBcastBegin(forest_, unit.get(), values.data(), ghosts, MPI_REPLACE));
  check(PetscSFBcastEnd(forest_, unit.get(), values.data(), ghosts, MPI_REPLACE));
}

void Halo::begin_copy_to_ghosts(std::span<double> values) const {
  assert(values.size() == static_cast<std::size_t>(num_owned_ + num_ghosts_));
  check(PetscSFBcastBegin(forest_, MPI_DOUBLE, values.data(), values.data() + num_owned_, MPI_REPLACE));
}

void Halo::end_copy_to_ghosts(std::span<double> values) const {
  check(PetscSFBcastEnd(forest_, MPI_DOUBLE, values.data(), values.data() + num_owned_, MPI_REPLACE));
}

void Halo::copy_to_ghosts(std::span<std::int32_t> values) const {
  check(PetscSFBcastBegin(forest_, MPI_INT32_T, values.data(), values.data() + num_owned_, MPI_REPLACE));
  check(PetscSFBcastEnd(forest_, MPI_INT32_T, values.data(), values.data() + num_owned_, MPI_REPLACE));
}

void Halo::copy_to_ghosts(std::span<std::int64_t> values) const {
  check(PetscSFBcastBegin(forest_, MPI_INT64_T, values.data(), values.data() + num_owned_, MPI_REPLACE));
  check(PetscSFBcastEnd(forest_, MPI_INT64_T, values.data(), values.data() + num_owned_, MPI_REPLACE));
}

void Halo::add_to_owners(std::span<double> values, int block) const {
  assert(values.size() == static_cast<std::size_t>(num_owned_ + num_ghosts_) * block);
  const BlockType unit(block);
  const double* ghosts = values.data() + static_cast<std::size_t>(num_owned_) * block;
  check(PetscSFReduceBegin(forest_, unit.get(), ghosts, values.data(), MPI_SUM));
  check(PetscSFReduceEnd(forest_, unit.get(), ghosts, values.data(), MPI_SUM));
}

void Halo::reduce(std::span<std::int32_t> values, MPI_Op operation) const {
  check(PetscSFReduceBegin(forest_, MPI_INT32_T, values.data() + num_owned_, values.data(), operation));
  check(PetscSFReduceEnd(forest_, MPI_INT32_T, values.data() + num_owned_, values.data(), operation));
}

void Halo::min_to_owners(std::span<std::int32_t> values) const { reduce(values, MPI_MIN); }
void Halo::max_to_owners(std::span<std::int32_t> values) const { reduce(values, MPI_MAX); }

}  // namespace vocalis::base
