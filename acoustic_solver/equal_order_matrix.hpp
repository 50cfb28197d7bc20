#pragma once

#include <memory>
#include <vector>

#include "acoustic_solver/wave_operator.hpp"
#include "core/la/petsc.hpp"

namespace vocalis::acoustic {

/// The matrix of a sub-step of equal-order P1/P1 as a product: that of P1/P0, which is assembled, with
/// `WaveOperator::add_subscales`.
class EqualOrderMatrix {
 public:
  /// assembled    of P1/P0, with 1 on the diagonal of constrained rows
  /// constrained  owned vertices
  /// All must outlive the object. Collective.
  EqualOrderMatrix(const fem::Space& space, Mat assembled, const std::vector<std::int32_t>& constrained);

  /// Of which step; `wave` must outlive the products.
  void set(const WaveOperator& wave, double b);
  Mat get() const { return matrix_.get(); }

 private:
  struct Product {
    const fem::Space* space;
    Mat assembled;
    const std::vector<std::int32_t>* constrained;
    const WaveOperator* wave;
    double b;
  };
  static PetscErrorCode multiply(Mat matrix, Vec x, Vec y);

  std::unique_ptr<Product> product_;
  la::PetscMatrix matrix_;
};

}  // namespace vocalis::acoustic
