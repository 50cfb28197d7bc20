#include "fsi_solver/solution/secants.hpp"

#include "core/base/mpi.hpp"

namespace vocalis::fsi {

namespace {

/// A step that the residual says to have done the opposite of what it should: no secant is taken from it.
constexpr double least_curvature = 0.1;

void copy(Vec from, la::PetscVector& to) {
  if (!to) base::check(VecDuplicate(from, to.put()));
  base::check(VecCopy(from, to.get()));
}

}  // namespace

Secants::Secants(MPI_Comm comm, PetscInt first_entries, int most)
    : comm_(comm), first_entries_(first_entries), most_(static_cast<std::size_t>(most)) {}

void Secants::clear() {
  count_ = 0;
  has_step_ = false;
}

double Secants::product(Vec a, Vec b) const {
  const la::ReadValues first(a), second(b);
  double sum = 0;
  for (PetscInt i = 0; i < first_entries_; ++i) sum += first[i] * second[i];
  return base::sum(comm_, sum);
}

void Secants::improve(Vec change) {
  base::check(VecScale(change, -1));
  for (std::size_t j = 0; j < count_; ++j) {
    base::check(VecAXPY(change, product(pairs_[j].step.get(), change), pairs_[j].weight.get()));
  }
  if (has_step_) {
    const double squared = product(step_.get(), step_.get());
    const double curvature = squared - product(step_.get(), change);
    if (curvature > least_curvature * squared) {
      if (count_ == most_) count_ = 0;
      if (pairs_.size() == count_) pairs_.emplace_back();
      Pair& pair = pairs_[count_++];
      copy(step_.get(), pair.step);
      copy(change, pair.weight);
      base::check(VecScale(pair.weight.get(), 1 / curvature));
      base::check(VecAXPY(change, product(step_.get(), change), pair.weight.get()));
    }
  }
  copy(change, step_);
  has_step_ = true;
  base::check(VecScale(change, -1));
}

}  // namespace vocalis::fsi
