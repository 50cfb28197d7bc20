#include "acoustic_solver/equal_order_matrix.hpp"

#include <algorithm>

namespace vocalis::acoustic {

EqualOrderMatrix::EqualOrderMatrix(const fem::Space& space, Mat assembled, const std::vector<std::int32_t>& constrained)
    : product_(std::make_unique<Product>(Product{&space, assembled, &constrained, nullptr, 0})) {
  MPI_Comm comm = MPI_COMM_NULL;
  base::check(PetscObjectGetComm(reinterpret_cast<PetscObject>(assembled), &comm));
  const PetscInt rows = space.dofs.num_owned;
  base::check(MatCreateShell(comm, rows, rows, PETSC_DETERMINE, PETSC_DETERMINE, product_.get(), matrix_.put()));
  base::check(MatShellSetOperation(matrix_.get(), MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
}

void EqualOrderMatrix::set(const WaveOperator& wave, double b) {
  product_->wave = &wave;
  product_->b = b;
}

PetscErrorCode EqualOrderMatrix::multiply(Mat matrix, Vec x, Vec y) {
  const Product* product = nullptr;
  base::check(MatShellGetContext(matrix, &product));
  base::check(MatMult(product->assembled, x, y));
  const fem::Space& space = *product->space;
  std::vector<double> values(space.dofs.num_local()), sums(values.size(), 0.0);
  {
    const la::ReadValues given(x);
    std::copy_n(given.data(), space.dofs.num_owned, values.begin());
  }
  for (const std::int32_t v : *product->constrained) values[v] = 0;
  space.halo.copy_to_ghosts(values);
  product->wave->add_subscales(product->b, values, sums);
  space.halo.add_to_owners(sums);
  for (const std::int32_t v : *product->constrained) sums[v] = 0;
  const la::OwnedValues result(y);
  for (std::int32_t v = 0; v < space.dofs.num_owned; ++v) result[v] += sums[v];
  return 0;
}

}  // namespace vocalis::acoustic
