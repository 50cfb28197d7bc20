#pragma once

#include "core/mesh/mesh.hpp"
#include "fsi_solver/cells/element.hpp"

namespace vocalis::fsi {

/// Share of a cell's smallest height that the middle of an edge may be off its chord. A cell with one such edge turns
/// over at a quarter; two edges are allowed for.
inline constexpr double largest_bow = 0.1;

/// Holds the middles of the edges of quadratic cells near their chords, so that a cell with corners in order is one in
/// order: where walls come near each other, cells between them get thinner than a wall's edges are bowed. Such a wall
/// and the fluid beside it then differ in shape by less than that bow; other cells stay as they are, to the last bit.
template <int D, int Degree>
void limit_bow(Lanes (&position)[Element<D, Degree>::nodes][D]) {
  if constexpr (Degree == 2) {
    Matrix<D, Lanes> sides{};
    Lanes longest{};  // squared
    const auto edges = mesh::edges_of_cell(D);
    for (const auto& [a, b] : edges) {
      Lanes square{};
      for (int k = 0; k < D; ++k) square += (position[b][k] - position[a][k]) * (position[b][k] - position[a][k]);
      longest = longest < square ? square : longest;
    }
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < D; ++k) sides[i][k] = position[i + 1][k] - position[0][k];
    }
    const Lanes measure = determinant<D>(sides);
    const Lanes height = (measure > 0 ? measure : Lanes{}) / (D == 2 ? square_root(longest) : longest);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto& [a, b] = edges[e];
      auto& middle = position[D + 1 + e];
      Lanes bow[D], square{};
      for (int k = 0; k < D; ++k) {
        bow[k] = middle[k] - 0.5 * (position[a][k] + position[b][k]);
        square += bow[k] * bow[k];
      }
      const Lanes most = largest_bow * height;
      const auto is_bowed = square > most * most;
      const Lanes share = most / square_root(square);
      for (int k = 0; k < D; ++k) {
        middle[k] = is_bowed ? 0.5 * (position[a][k] + position[b][k]) + share * bow[k] : middle[k];
      }
    }
  }
}

}  // namespace vocalis::fsi
