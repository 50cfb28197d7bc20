#include "transfer/fill.hpp"

#include <cmath>
#include <map>
#include <set>

#include "core/base/mpi.hpp"
#include "tests/all_ranks.hpp"
#include "tests/transfer/random_case.hpp"
#include "tests/transfer/world_split.hpp"
#include "transfer/strip.hpp"

using namespace vocalis;
using namespace vocalis::transfer;

namespace {

double value_at(std::int64_t vertex) { return std::sin(1.0 + 3.0 * static_cast<double>(vertex)); }
bool is_known(std::int64_t vertex) { return vertex % 4 == 0; }

/// Values at the vertices of a strip over the whole mesh: those that are not known get the mean of their neighbours
/// that have a value, in 32 sweeps, or as many as it takes to reach all.
std::map<std::int64_t, double> filled(const RandomCase& test, const std::vector<std::int32_t>& mask) {
  std::map<std::int64_t, std::set<std::int64_t>> neighbours;
  const int corners = test.whole.dimension + 1;
  for (std::int64_t cell = 0; cell < test.whole.num_cells(); ++cell) {
    const auto first = test.whole.cell_vertices.begin() + cell * corners;
    if (!mask[cell]) continue;
    for (int i = 0; i < corners; ++i) neighbours[first[i]].insert(first, first + corners);
  }
  std::map<std::int64_t, double> values;
  for (const auto& [vertex, others] : neighbours) {
    if (is_known(vertex)) values[vertex] = value_at(vertex);
  }
  std::size_t count = 0;
  for (int sweep = 0; sweep < 32 || values.size() > count; ++sweep) {
    count = values.size();
    const std::map<std::int64_t, double> before = values;
    for (const auto& [vertex, others] : neighbours) {
      double sum = 0, number = 0;
      for (const std::int64_t other : others) {
        if (other == vertex || !before.contains(other)) continue;
        sum += before.at(other);
        ++number;
      }
      if (!is_known(vertex) && number > 0) values[vertex] = sum / number;
    }
  }
  return values;
}

}  // namespace

TEST_CASE("vertices without a value take the mean of their neighbours, from the known ones inwards") {
  const WorldSplits splits;
  for (int trial = 0; trial < 60; ++trial) {
    const auto& split = splits.turn(trial);
    Random random(9000 + 2 * trial + split.is_upper);
    const RandomCase test = random_case(random, base::size(split.comm));
    const auto mask = random_mask(random, test);
    const mesh::Mesh parent = test.distribute(split.comm);
    const StrippedMesh part = strip(parent, mask_of_rank(test, mask, base::rank(split.comm)));
    const fem::Space space = fem::lagrange(part.mesh, 1);
    fem::Field field(space, 2);
    std::vector<std::int32_t> known;
    for (std::int32_t i = 0; i < part.mesh.num_vertices(); ++i) {
      const std::int64_t vertex = part.mesh.vertex_input[i];
      known.push_back(is_known(vertex));
      field.at(i)[0] = is_known(vertex) ? value_at(vertex) : 17;  // what is not known does not count
      field.at(i)[1] = 2;
    }
    fill(field, known);
    const auto expected = filled(test, mask);
    bool right = true;
    for (std::int32_t i = 0; i < part.mesh.num_vertices(); ++i) {
      const std::int64_t vertex = part.mesh.vertex_input[i];
      const bool has = expected.contains(vertex);
      right = right && std::abs(field.at(i)[0] - (has ? expected.at(vertex) : 0)) <= (known[i] ? 0 : 1e-13);
      right = right && std::abs(field.at(i)[1] - (has ? 2 : 0)) <= 1e-14;
    }
    CHECK(right);
  }
}
