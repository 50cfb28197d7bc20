#include <cmath>

#include "core/base/mpi.hpp"
#include "core/fem/field.hpp"
#include "core/fem/simplex.hpp"
#include "core/fem/space.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;

namespace {

/// A quarter of a ring, 1 m < radius < 2 m, or of a tube of length 1 m: a box (r, angle, z) bent.
mesh::WholeMesh quarter_ring(int dimension, int cells) {
  mesh::WholeMesh whole =
      mesh::box(MPI_COMM_WORLD, {1, M_PI / 2, dimension == 3 ? 1.0 : 0.0}, {cells, 2 * cells, cells});
  const int d = whole.dimension;
  for (std::size_t first = 0; first < whole.coordinates.size(); first += d) {
    const double radius = 1 + whole.coordinates[first], angle = whole.coordinates[first + 1];
    whole.coordinates[first] = radius * std::cos(angle);
    whole.coordinates[first + 1] = radius * std::sin(angle);
  }
  return whole;
}

/// Names the middles of the edges on the inner and the outer side: between the radius of their ends.
void bend_edges(mesh::WholeMesh& whole) {
  const int d = whole.dimension;
  for (std::size_t facet = 0; facet < whole.facet_group.size(); ++facet) {
    if (whole.facet_group[facet] > 1) continue;
    for (int i = 0; i < d; ++i) {
      for (int j = i + 1; j < d; ++j) {
        const std::int64_t ends[] = {whole.facet_vertices[facet * d + i], whole.facet_vertices[facet * d + j]};
        const double *a = whole.coordinates.data() + ends[0] * d, *b = whole.coordinates.data() + ends[1] * d;
        std::array<double, 3> middle = {};
        for (int k = 0; k < d; ++k) middle[k] = 0.5 * (a[k] + b[k]);
        const double stretch = std::hypot(a[0], a[1]) / std::hypot(middle[0], middle[1]);
        if (stretch < 1 + 1e-10) continue;
        for (int k = 0; k < 2; ++k) middle[k] *= stretch;
        whole.curved_edges.insert(whole.curved_edges.end(), ends, ends + 2);
        whole.curved_points.insert(whole.curved_points.end(), middle.begin(), middle.begin() + d);
      }
    }
  }
}

/// Area or volume of the cells, mapped by the P2 basis and the points of its dofs.
double measure(const fem::Space& space) {
  const std::vector<double> points = fem::dof_points(space);
  const int d = space.mesh->dimension;
  const fem::QuadratureRule& rule = fem::quadrature(d, 4);
  std::vector<double> derivatives(static_cast<std::size_t>(space.dofs_per_cell) * (d + 1));
  double sum = 0;
  for (std::int32_t cell = 0; cell < space.mesh->num_cells(); ++cell) {
    for (std::size_t q = 0; q < rule.weights.size(); ++q) {
      fem::basis_derivatives(d, 2, rule.points[q], derivatives);
      double F[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      for (int k = 0; k < d; ++k) {
        for (int l = 0; l < d; ++l) {
          F[k][l] = 0;
          for (int a = 0; a < space.dofs_per_cell; ++a) {
            F[k][l] +=
                points[space.dofs_of(cell)[a] * d + k] * (derivatives[a * (d + 1) + l + 1] - derivatives[a * (d + 1)]);
          }
        }
      }
      sum += rule.weights[q] / (d == 2 ? 2 : 6) *
             (F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) - F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
              F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]));
    }
  }
  return base::sum(space.mesh->comm, sum);
}

double error_of_measure(int dimension, int cells, bool curved) {
  mesh::WholeMesh whole = quarter_ring(dimension, cells);
  if (curved) bend_edges(whole);
  const mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, whole);
  CHECK(mesh.edge_points.empty() == !curved);
  const fem::Space space = fem::lagrange(mesh, 2);
  fem::Field points(space, dimension);
  points.values = fem::dof_points(space);
  const auto before = points.values;
  points.copy_to_ghosts();
  CHECK(points.values == before);
  return std::abs(measure(space) - 0.75 * M_PI);
}

}  // namespace

TEST_CASE("the measure of curved P2 cells errs with the fourth power of their size, of straight ones with the second") {
  for (const int dimension : {2, 3}) {
    const int cells = dimension == 2 ? 4 : 2;
    for (const bool curved : {false, true}) {
      const double order =
          std::log2(error_of_measure(dimension, cells, curved) / error_of_measure(dimension, 2 * cells, curved));
      INFO("dimension " << dimension << ", curved " << curved);
      CHECK(order == Approx(curved ? 4 : 2).margin(0.1));
    }
  }
}
