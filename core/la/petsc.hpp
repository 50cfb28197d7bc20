#pragma once

#include <petscksp.h>
#include <petscsnes.h>

#include <utility>

#include "core/base/error.hpp"

namespace vocalis::la {

/// Owns one PETSc object: movable, destroyed once. Destroying is collective, so owners live and die on all ranks alike.
template <class Handle, PetscErrorCode (*Destroy)(Handle*)>
class Owner {
 public:
  Owner() = default;
  explicit Owner(Handle handle) : handle_(handle) {}
  ~Owner() {
    if (handle_) Destroy(&handle_);
  }
  Owner(Owner&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Owner& operator=(Owner&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  Owner(const Owner&) = delete;
  Owner& operator=(const Owner&) = delete;

  Handle get() const { return handle_; }
  Handle* put() { return &handle_; }
  explicit operator bool() const { return handle_ != nullptr; }

 private:
  Handle handle_ = nullptr;
};

using PetscVector = Owner<Vec, VecDestroy>;
using PetscMatrix = Owner<Mat, MatDestroy>;
using PetscLinearSolver = Owner<KSP, KSPDestroy>;
using PetscNonlinearSolver = Owner<SNES, SNESDestroy>;

/// A distributed vector of zeros with `num_owned` entries on this rank. Collective.
PetscVector create_vector(MPI_Comm comm, PetscInt num_owned);

/// The owned entries of a vector, for as long as the object lives.
class OwnedValues {
 public:
  explicit OwnedValues(Vec vector) : vector_(vector) { base::check(VecGetArray(vector_, &values_)); }
  ~OwnedValues() { VecRestoreArray(vector_, &values_); }
  OwnedValues(const OwnedValues&) = delete;
  OwnedValues& operator=(const OwnedValues&) = delete;
  double& operator[](PetscInt i) const { return values_[i]; }
  double* data() const { return values_; }

 private:
  Vec vector_;
  double* values_ = nullptr;
};

/// The same, to read only.
class ReadValues {
 public:
  explicit ReadValues(Vec vector) : vector_(vector) { base::check(VecGetArrayRead(vector_, &values_)); }
  ~ReadValues() { VecRestoreArrayRead(vector_, &values_); }
  ReadValues(const ReadValues&) = delete;
  ReadValues& operator=(const ReadValues&) = delete;
  double operator[](PetscInt i) const { return values_[i]; }
  const double* data() const { return values_; }

 private:
  Vec vector_;
  const double* values_ = nullptr;
};

}  // namespace vocalis::la
