#include "fsi_solver/cells/element.hpp"

namespace vocalis::fsi {

namespace {

template <int D, int Degree>
typename Element<D, Degree>::Point point_at(const std::array<double, 4>& where, double weight) {
  using E = Element<D, Degree>;
  typename E::Point point{};
  point.weight = weight;
  std::array<double, E::nodes> values;
  std::array<double, E::nodes*(D + 1)> derivatives;
  fem::basis_values(D, Degree, where, values);
  fem::basis_derivatives(D, Degree, where, derivatives);
  for (int a = 0; a < E::nodes; ++a) {
    point.value[a] = values[a];
    for (int j = 0; j < D; ++j) point.derivative[a][j] = derivatives[a * (D + 1) + j + 1] - derivatives[a * (D + 1)];
  }
  for (int b = 0; b <= D; ++b) point.corner[b] = where[b];
  return point;
}

template <int D, int Degree>
std::vector<typename Element<D, Degree>::Point> points_of_cell() {
  const int exactness = Degree == 1 ? 2 : (D == 2 ? 5 : 4);
  const fem::QuadratureRule& rule = fem::quadrature(D, exactness);
  std::vector<typename Element<D, Degree>::Point> result;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    result.push_back(point_at<D, Degree>(rule.points[q], rule.weights[q] / (D == 2 ? 2 : 6)));
  }
  return result;
}

template <int D, int Degree>
std::vector<typename Element<D, Degree>::Point> points_of_facet(int facet) {
  const fem::QuadratureRule& rule = fem::quadrature(D - 1, Degree == 1 ? 2 : 5);
  std::vector<typename Element<D, Degree>::Point> result;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    std::array<double, 4> where = {0, 0, 0, 0};
    for (int b = 0, i = 0; b <= D; ++b) {
      if (b != facet) where[b] = rule.points[q][i++];
    }
    result.push_back(point_at<D, Degree>(where, rule.weights[q]));
  }
  return result;
}

}  // namespace

template <int D, int Degree>
const std::vector<typename Element<D, Degree>::Point>& Element<D, Degree>::points() {
  static const std::vector<Point> result = points_of_cell<D, Degree>();
  return result;
}

template <int D, int Degree>
const std::vector<typename Element<D, Degree>::Point>& Element<D, Degree>::facet_points(int facet) {
  static const auto result = [] {
    std::array<std::vector<Point>, corners> all;
    for (int i = 0; i < corners; ++i) all[i] = points_of_facet<D, Degree>(i);
    return all;
  }();
  return result[facet];
}

template struct Element<2, 1>;
template struct Element<2, 2>;
template struct Element<3, 1>;
template struct Element<3, 2>;

}  // namespace vocalis::fsi
