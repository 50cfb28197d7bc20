#include "fsi_solver/cells/constitutive.hpp"

#include <catch2/catch.hpp>

#include "tests/fsi_solver/matrices.hpp"

namespace vocalis::fsi {

using namespace test;

namespace {

template <int D>
void check_tangent(const Elasticity& solid, double pressure) {
  Matrix<D> f = some_matrix<D>(1, 0.3);
  for (int i = 0; i < D; ++i) f[i][i] += 1;
  const Matrix<D> rate = some_matrix<D>(2, 20), df = some_matrix<D>(3, 1), df_rate = some_matrix<D>(4, 50);
  // Central differences: error of order step², 1e-10 relative to the third derivative, plus rounding 1e-16 / step.
  const double step = 1e-5;
  const auto ahead = stress<D>(solid, sum<D>(f, step, df), sum<D>(rate, step, df_rate), pressure);
  const auto behind = stress<D>(solid, sum<D>(f, -step, df), sum<D>(rate, -step, df_rate), pressure);
  const Matrix<D> exact = stress_change<D>(solid, f, rate, pressure, df, df_rate);
  Matrix<D> difference = sum<D>(ahead, -1, behind);
  for (auto& row : difference) {
    for (double& value : row) value /= 2 * step;
  }
  CHECK(largest<D>(sum<D>(difference, -1, exact)) < 1e-7 * largest<D>(exact));
}

Matrix<2> rotation(double angle) { return {{{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}}}; }

}  // namespace

TEST_CASE("the change of a stress is its derivative", "[serial]") {
  for (const SolidModel model : {SolidModel::neo_hookean, SolidModel::saint_venant_kirchhoff}) {
    for (const double pressure : {0.0, 700.0}) {
      const Elasticity solid = {model, 1500, 4000, 0.8};
      check_tangent<2>(solid, pressure);
      check_tangent<3>(solid, pressure);
    }
  }
}

TEST_CASE("a rigid motion gives no stress", "[serial]") {
  for (const SolidModel model : {SolidModel::neo_hookean, SolidModel::saint_venant_kirchhoff}) {
    const Elasticity solid = {model, 1500, 4000, 3};
    const double spin = 200;  // rad/s
    const Matrix<2> f = rotation(2.1);
    const Matrix<2> rate = product<2>({{{0, -spin}, {spin, 0}}}, f);
    CHECK(largest<2>(stress<2>(solid, f, rate, 0)) < 1e-9 * solid.shear);
  }
}

TEST_CASE("the stress turns with the material", "[serial]") {
  const Elasticity solid = {SolidModel::neo_hookean, 1500, 4000, 3};
  Matrix<2> f = some_matrix<2>(1, 0.2);
  for (int i = 0; i < 2; ++i) f[i][i] += 1;
  const Matrix<2> rate = some_matrix<2>(2, 30), turn = rotation(0.7);
  const Matrix<2> spin = {{{0, -90}, {90, 0}}};
  const Matrix<2> turned_f = product<2>(turn, f);
  const Matrix<2> turned_rate = sum<2>(product<2>(turn, rate), 1, product<2>(spin, turned_f));
  const Matrix<2> expected = product<2>(turn, stress<2>(solid, f, rate, 50));
  CHECK(largest<2>(sum<2>(stress<2>(solid, turned_f, turned_rate, 50), -1, expected)) < 1e-10 * largest<2>(expected));
}

TEST_CASE("for small strains the neo-Hookean and the Saint Venant-Kirchhoff solid agree with Hooke's law", "[serial]") {
  SolidMaterial material;
  material.young_modulus = 9000;
  material.poisson_ratio = 0.35;
  const double strain = 1e-6;
  // Uniaxial strain: stress = (λ + 2 µ) ε along, λ ε across.
  const double along = 9000 * (1 - 0.35) / ((1 + 0.35) * (1 - 0.7)), across = 9000 * 0.35 / ((1 + 0.35) * (1 - 0.7));
  for (const SolidModel model : {SolidModel::neo_hookean, SolidModel::saint_venant_kirchhoff}) {
    material.model = model;
    const Matrix<3> p = stress<3, double>(elasticity(material), {{{1 + strain, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {}, 0);
    CHECK(p[0][0] == Approx(along * strain).epsilon(1e-5));
    CHECK(p[1][1] == Approx(across * strain).epsilon(1e-5));
  }
}

}  // namespace vocalis::fsi
