#pragma once

#include "fsi_solver/cells/cell_input.hpp"
#include "fsi_solver/cells/sliding.hpp"

namespace vocalis::fsi {

/// What a solid answers to its deformation; that of contact cells with full friction, too.
template <int D>
struct BulkLaw {
  const Elasticity& solid;

  Lanes energy(const Matrix<D, Lanes>& f) const { return stored_energy<D>(solid, f); }
  /// In a volume [W].
  Lanes dissipation(const Lanes& volume, const Matrix<D, Lanes>& f, const Matrix<D, Lanes>& rate_of_f) const {
    const Matrix<D, Lanes> rate = symmetric_product<D>(rate_of_f, f);
    return 2 * solid.viscosity * volume * contraction<D>(rate, rate);
  }
  Matrix<D, Lanes> stress(const Matrix<D, Lanes>& f, const Matrix<D, Lanes>& rate_of_f, const Lanes& pressure) const {
    return vocalis::fsi::stress<D>(solid, f, rate_of_f, pressure);
  }
  Matrix<D, Lanes> stress_change(const Matrix<D, Lanes>& f, const Matrix<D, Lanes>& rate_of_f, const Lanes& pressure,
                                 const Matrix<D, Lanes>& df, const Matrix<D, Lanes>& df_rate) const {
    return vocalis::fsi::stress_change<D>(solid, f, rate_of_f, pressure, df, df_rate);
  }
};

/// That of contact cells without friction.
template <int D>
struct SlidingLaw {
  const Elasticity& medium;
  const std::array<Lanes, D>& normal;

  Lanes energy(const Matrix<D, Lanes>& f) const { return sliding_energy<D>(medium, f, normal); }
  Lanes dissipation(const Lanes& volume, const Matrix<D, Lanes>& f, const Matrix<D, Lanes>& rate_of_f) const {
    return volume * sliding_dissipation<D>(medium, f, rate_of_f, normal);
  }
  Matrix<D, Lanes> stress(const Matrix<D, Lanes>& f, const Matrix<D, Lanes>& rate_of_f, const Lanes& pressure) const {
    return sliding_stress<D>(medium, f, rate_of_f, pressure, normal);
  }
  Matrix<D, Lanes> stress_change(const Matrix<D, Lanes>& f, const Matrix<D, Lanes>& rate_of_f, const Lanes& pressure,
                                 const Matrix<D, Lanes>& df, const Matrix<D, Lanes>& df_rate) const {
    return sliding_stress_change<D>(medium, f, rate_of_f, pressure, normal, df, df_rate);
  }
};

/// Calls a function with the law of a batch of cells.
template <int D, int Degree, class Function>
auto with_law(const Elasticity& solid, const CellInput<D, Degree>& in, const Function& function) {
  return solid.slides ? function(SlidingLaw<D>{solid, in.normal}) : function(BulkLaw<D>{solid});
}

}  // namespace vocalis::fsi
