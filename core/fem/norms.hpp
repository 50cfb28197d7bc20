#pragma once

#include <vector>

#include "core/fem/field.hpp"
#include "core/fem/interpolate.hpp"

namespace vocalis::fem {

/// All norms run over the cells where the field's space exists, on the mesh's present coordinates; ghosts must be
/// current. `degree` is that of the quadrature (at most 5 on triangles, 4 on tetrahedra). All are collective, and the
/// same number on every rank.

/// ( ∫ |u|² dx )^(1/2)
double l2_norm(const Field& field, int degree = 4);

/// ( ∫ |u - exact|² dx )^(1/2); `exact` writes one value a component.
double l2_error(const Field& field, const PointFunction& exact, int degree = 4);

/// ( ∫ |∇u|² dx )^(1/2)
double h1_seminorm(const Field& field, int degree = 4);

/// ( ∫ |∇u - exact|² dx )^(1/2); `exact` writes (components, dimension): ∂u_c/∂x_k at c * dimension + k.
double h1_seminorm_error(const Field& field, const PointFunction& exact_gradient, int degree = 4);

/// ∫ u_c dx of each component c.
std::vector<double> integral(const Field& field);

}  // namespace vocalis::fem
