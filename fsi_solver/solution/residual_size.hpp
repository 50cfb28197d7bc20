#pragma once

#include <mpi.h>

#include <vector>

namespace vocalis::fsi {

/// How far the equations are from being solved: the largest, over fields and regions, of |residual| / |cells' terms|.
struct ResidualSize {
  double error = 0;
  bool inverted = false;  ///< some cell has no positive volume at the stage; `error` is then meaningless
};

/// Sums of squares over a rank that make a ResidualSize: momentum of the fluid (label 0) and of each solid, then mass
/// of each label, then projection of each label.
class ResidualSums {
 public:
  enum Equation { momentum, mass, projection };

  explicit ResidualSums(int labels) : labels_(labels), sums_(static_cast<std::size_t>(6 * labels) + 1, 0.0) {}

  /// Squares of the terms of cells, before the cells are summed.
  void add_terms(Equation equation, int label, double squares) { sums_[equation * labels_ + label] += squares; }
  /// One owned entry of the residual.
  void add_entry(Equation equation, int label, double value) {
    sums_[(3 + equation) * labels_ + label] += value * value;
  }
  void mark_inverted() { sums_.back() = 1; }

  /// The same on every rank; NaN if any residual is. Collective.
  ResidualSize total(MPI_Comm comm);

 private:
  int labels_;
  std::vector<double> sums_;  ///< terms, then entries, each (equations, labels); then whether a cell is inverted
};

}  // namespace vocalis::fsi
