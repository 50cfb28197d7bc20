#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/la/condensation.hpp"
#include "core/la/petsc.hpp"

namespace vocalis::la {

/// A direct solver that all ranks share: each eliminates the unknowns that only it has, the others, of a separator,
/// make a dense system S x = r, summed over ranks, that every rank factors. The same bit by bit in every run on the
/// same ranks, unlike MUMPS across ranks, which sums in the order in which messages arrive. For few ranks: the dense
/// system grows with them. Source: Przemieniecki 1963, AIAA J. 1, 138.
class Substructuring {
 public:
  /// separator  see `find_separator`. Its matrix must outlive this. Collective.
  Substructuring(Mat matrix, std::vector<PetscInt> separator);

  /// Operations of one factorisation of the dense system, which all ranks do alike, over those that they share, which
  /// are somewhat less than one rank would need for the whole. Collective.
  double dense_share() const;

  /// Of the matrix's present values. Returns false, on all ranks, if one of them cannot eliminate what only it has (see
  /// `Condensation`), or the system is singular. Collective.
  bool factorise();
  /// Collective.
  void solve(Vec right_hand_side, Vec solution);

 private:
  std::vector<PetscInt> rows_of_block() const;
  void find_entries();

  Mat matrix_;
  std::vector<PetscInt> separator_;
  Owner<IS, ISDestroy> block_;                   ///< global rows, ascending: of this rank alone, and the separator's
  std::unique_ptr<Mat[], void (*)(Mat*)> copy_;  ///< one: the block's rows and columns
  MatrixEntries entries_;                    ///< of the block, those of the separator alone only where they are owned
  std::vector<std::size_t> entry_to_value_;  ///< of the copy
  std::vector<int> separator_to_block_;
  std::vector<std::pair<int, int>> owned_and_block_;  ///< positions of each owned row
  std::vector<double> load_, values_, shared_matrix_;
  std::optional<Condensation> condensation_;  ///< none where nothing is to be eliminated
  std::vector<PetscBLASInt> pivots_;
};

}  // namespace vocalis::la
