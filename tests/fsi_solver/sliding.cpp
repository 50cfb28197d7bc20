// The contact medium without friction, at a point.
#include "fsi_solver/cells/sliding.hpp"

#include <catch2/catch.hpp>

#include "tests/fsi_solver/matrices.hpp"

namespace vocalis::fsi {

using namespace test;

namespace {

const Elasticity without_film = {SolidModel::neo_hookean, 1500, 0, 0.8, true, 0};
const Elasticity medium = {SolidModel::neo_hookean, 1500, 0, 0.8, true, 0.3};

template <int D>
Matrix<D> some_deformation() {
  Matrix<D> f = some_matrix<D>(1, 0.3);
  for (int i = 0; i < D; ++i) f[i][i] += 1;
  return f;
}

/// Of unit length, along no axis.
template <int D>
std::array<double, D> some_normal() {
  if constexpr (D == 2) {
    return {0.6, -0.8};
  } else {
    return {2.0 / 7, -3.0 / 7, 6.0 / 7};
  }
}

/// Unit vectors along the plane, the first is one of them.
template <int D>
std::array<double, D> some_tangent() {
  if constexpr (D == 2) {
    return {0.8, 0.6};
  } else {
    return {6.0 / 7, -2.0 / 7, -3.0 / 7};
  }
}

template <int D>
Matrix<D> outer(const std::array<double, D>& a, const std::array<double, D>& b) {
  Matrix<D> c{};
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) c[i][j] = a[i] * b[j];
  }
  return c;
}

/// Central differences: error of order step², 1e-10 relative to the third derivative, plus rounding 1e-16 / step.
constexpr double difference_step = 1e-5;

template <int D>
void check_tangent(double pressure) {
  const auto normal = some_normal<D>();
  const Matrix<D> f = some_deformation<D>();
  const Matrix<D> rate = some_matrix<D>(2, 20), df = some_matrix<D>(3, 1), df_rate = some_matrix<D>(4, 50);
  const double step = difference_step;
  const auto at = [&](double way) {
    return sliding_stress<D>(medium, sum<D>(f, way, df), sum<D>(rate, way, df_rate), pressure, normal);
  };
  Matrix<D> difference = sum<D>(at(step), -1, at(-step));
  for (auto& row : difference) {
    for (double& value : row) value /= 2 * step;
  }
  const Matrix<D> exact = sliding_stress_change<D>(medium, f, rate, pressure, normal, df, df_rate);
  CHECK(largest<D>(sum<D>(difference, -1, exact)) < 1e-7 * largest<D>(exact));
}

template <int D>
void check_potential() {
  const auto normal = some_normal<D>();
  const Matrix<D> f = some_deformation<D>(), df = some_matrix<D>(3, 1);
  const double step = difference_step;
  const double ahead = sliding_energy<D>(medium, sum<D>(f, step, df), normal);
  const double behind = sliding_energy<D>(medium, sum<D>(f, -step, df), normal);
  const double power = contraction<D>(sliding_stress<D>(medium, f, {}, 0, normal), df);
  CHECK((ahead - behind) / (2 * step) == Approx(power).epsilon(1e-7));
  // What viscosity takes is its stress times the rate.
  const Matrix<D> rate = some_matrix<D>(2, 20);
  const Matrix<D> viscous =
      sum<D>(sliding_stress<D>(medium, f, rate, 0, normal), -1, sliding_stress<D>(medium, f, {}, 0, normal));
  CHECK(sliding_dissipation<D>(medium, f, rate, normal) == Approx(contraction<D>(viscous, rate)).epsilon(1e-10));
}

template <int D>
void check_area() {
  const auto normal = some_normal<D>();
  const Matrix<D> f = some_deformation<D>(), cof = cofactor<D>(f);
  double square = 0;
  for (int i = 0; i < D; ++i) {
    double m = 0;
    for (int k = 0; k < D; ++k) m += cof[i][k] * normal[k];
    square += m * m;
  }
  CHECK(contact_plane<D>(f, normal).square == Approx(square).epsilon(1e-12));
}

template <int D>
void check_shear() {
  const auto normal = some_normal<D>();
  Matrix<D> shear = outer<D>(some_tangent<D>(), normal), slide = shear;
  const Matrix<D> rate = shear;
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) slide[i][k] = 3 * shear[i][k] + (i == k ? 1.0 : 0.0);
  }
  CHECK(largest<D>(sliding_stress<D>(without_film, slide, rate, 0, normal)) < 1e-12 * medium.shear);
  CHECK(largest<D>(stress<D>(medium, slide, rate, 0)) > medium.shear);
  // A film shears as a fluid does: |t·P N| = η_f γ'.
  const Matrix<D> dragged = sliding_stress<D>(medium, slide, rate, 0, normal);
  CHECK(contraction<D>(dragged, shear) == Approx(medium.film));
  // Upon any other deformation, too.
  const Matrix<D> f = some_deformation<D>();
  CHECK(sliding_energy<D>(medium, product<D>(f, slide), normal) ==
        Approx(sliding_energy<D>(medium, f, normal)).epsilon(1e-10));
}

template <int D>
void check_turn(const Matrix<D>& turn, const Matrix<D>& spin) {
  const auto normal = some_normal<D>();
  const Matrix<D> f = some_deformation<D>(), rate = some_matrix<D>(2, 30);
  const Matrix<D> turned_f = product<D>(turn, f);
  const Matrix<D> turned_rate = sum<D>(product<D>(turn, rate), 1, product<D>(spin, turned_f));
  const Matrix<D> expected = product<D>(turn, sliding_stress<D>(medium, f, rate, 50, normal));
  CHECK(largest<D>(sum<D>(sliding_stress<D>(medium, turned_f, turned_rate, 50, normal), -1, expected)) <
        1e-10 * largest<D>(expected));
}

/// t·σ·t - n·σ·n in the plane strain F = a t ⊗ t + (1 / a) n ⊗ n + the rest of I: no pressure has a part in it.
template <int D>
double difference_of_stresses(const Matrix<D>& p, double a) {
  const auto normal = some_normal<D>(), tangent = some_tangent<D>();
  double along = 0, across = 0;
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) {
      along += tangent[i] * p[i][k] * tangent[k] * a;
      across += normal[i] * p[i][k] * normal[k] / a;
    }
  }
  return along - across;
}

template <int D>
void check_plane_strain() {
  const auto normal = some_normal<D>(), tangent = some_tangent<D>();
  const auto stretch = [&](double along, double across) {
    return sum<D>(sum<D>({}, along, outer<D>(tangent, tangent)), across, outer<D>(normal, normal));
  };
  for (const double a : {0.7, 1 + 1e-6, 1.6}) {
    Matrix<D> f = stretch(a - 1, 1 / a - 1);
    for (int i = 0; i < D; ++i) f[i][i] += 1;
    for (const double speed : {0.0, 5000.0}) {
      const Matrix<D> rate = stretch(speed, -speed / (a * a));
      const double none = difference_of_stresses<D>(sliding_stress<D>(without_film, f, rate, 300, normal), a);
      const double full = difference_of_stresses<D>(stress<D>(without_film, f, rate, -200), a);
      CHECK(none == Approx(full).epsilon(1e-8));
    }
    // Where the volume is not kept, too.
    const Matrix<D> swollen = sum<D>(f, 0.1, outer<D>(normal, normal));
    const Matrix<D> none = sliding_stress<D>(without_film, swollen, {}, 0, normal);
    const Matrix<D> full = stress<D>(without_film, swollen, {}, 0);
    for (const auto& direction : {tangent, normal}) {
      CHECK(contraction<D>(none, outer<D>(direction, direction)) ==
            Approx(contraction<D>(full, outer<D>(direction, direction))).epsilon(1e-8));
    }
    if (a < 1.1 && a > 1) {
      const double none = difference_of_stresses<D>(sliding_stress<D>(medium, f, {}, 0, normal), a);
      CHECK(none == Approx(4 * medium.shear * (a - 1)).epsilon(1e-5));
    }
  }
}

}  // namespace

TEST_CASE("the change of a contact stress without friction is its derivative", "[serial]") {
  for (const double pressure : {0.0, 700.0}) {
    check_tangent<2>(pressure);
    check_tangent<3>(pressure);
  }
}

TEST_CASE("the contact stress without friction is that of its energy, which knows the area of the plane", "[serial]") {
  check_area<2>();
  check_area<3>();
  check_potential<2>();
  check_potential<3>();
}

TEST_CASE("no shear along the plane of contact meets a stress", "[serial]") {
  check_shear<2>();
  check_shear<3>();
}

TEST_CASE("the contact stress without friction turns with the material", "[serial]") {
  const double c = std::cos(0.7), s = std::sin(0.7);
  check_turn<2>({{{c, -s}, {s, c}}}, {{{0, -90}, {90, 0}}});
  check_turn<3>({{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}}, {{{0, -90, 30}, {90, 0, -40}, {-30, 40, 0}}});
}

TEST_CASE("across the plane of contact a layer in plane strain is as stiff as with friction", "[serial]") {
  check_plane_strain<2>();
  check_plane_strain<3>();
}

}  // namespace vocalis::fsi
