#include "contact/contact_search.hpp"

#include <algorithm>
#include <limits>

#include "core/base/mpi.hpp"
#include "core/mesh/facets.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::contact {
namespace {

/// A channel 0 < x < 2 of cells of 0.1 (h = 0.1) with walls at the bottom and the top.
struct Channel {
  explicit Channel(int across, const ContactSettings& settings = {})
      : mesh(mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {2, 0.1 * across, 0}, {20, across, 0}))),
        fluid(mesh.cells.num_local(), 1),
        search(mesh, fluid, walls(), {}, settings),
        state(search.open_state()) {
    load.normal_stress.assign(mesh.num_cells(), -1);
    load.fluid_pressure.assign(mesh.num_cells(), std::numeric_limits<double>::quiet_NaN());
  }
  std::vector<mesh::NamedFacet> walls() const {
    std::vector<mesh::NamedFacet> result = mesh::facets_of_group(mesh, "bottom");
    for (const auto& facet : mesh::facets_of_group(mesh, "top")) result.push_back(facet);
    return result;
  }
  /// All heights times a factor.
  std::vector<double> squeezed(double (*factor)(double x)) const {
    std::vector<double> result = mesh.coordinates;
    for (std::size_t i = 0; i < result.size(); i += 2) result[i + 1] *= factor(result[i]);
    return result;
  }
  ContactProposal move(double (*factor)(double x)) {
    ContactProposal proposal = search.propose(squeezed(factor), state, load);
    state = proposal.state;
    return proposal;
  }
  std::int64_t in_contact() const {
    return base::sum(mesh.comm,
                     static_cast<std::int64_t>(std::count(state.in_contact.begin(), state.in_contact.end(), 1)));
  }

  mesh::Mesh mesh;
  std::vector<char> fluid;
  ContactSearch search;
  ContactState state;
  ContactLoad load;
};

TEST_CASE("Cells close where the gap is below that of alpha, and open where it is wider by the release gap") {
  Channel channel(4);  // closes below 2 * 0.25 * 0.1 = 0.05
  CHECK(channel.move([](double) { return 0.13; }).closed == 0);
  const ContactProposal closing = channel.move([](double) { return 0.1; });
  CHECK(closing.closing == closing.closed);
  CHECK(closing.closed >= 40);
  CHECK(closing.depth == Approx(0.8));
  CHECK(channel.in_contact() == base::sum(channel.mesh.comm, static_cast<std::int64_t>(channel.mesh.num_cells())));
  CHECK(channel.move([](double) { return 0.119; }).opening == 0);
  CHECK(channel.move([](double) { return 0.121; }).closed == 0);
  CHECK(channel.in_contact() == 0);
}

TEST_CASE("Without the gaps at rest nothing is proposed, and the reason is told") {
  Channel channel(4);
  ContactSettings settings;
  settings.distance = DistanceMethod::eikonal;
  const std::vector<double> good = channel.mesh.coordinates;
  for (double& coordinate : channel.mesh.coordinates) coordinate = std::numeric_limits<double>::quiet_NaN();
  ContactSearch search(channel.mesh, channel.fluid, channel.walls(), {}, settings);
  channel.mesh.coordinates = good;
  const ContactProposal proposal =
      search.propose(channel.squeezed([](double) { return 0.1; }), channel.state, channel.load);
  REQUIRE_ON_ALL_RANKS(proposal.reason.find("at rest") != std::string::npos);
  CHECK(proposal.closed == 0);
}

TEST_CASE("A channel that is narrow at rest does not close before its gap has halved") {
  ContactSettings settings;
  settings.alpha = 1;
  Channel channel(1, settings);
  CHECK(channel.move([](double) { return 1.0; }).closed == 0);
  CHECK(channel.move([](double) { return 0.51; }).closed == 0);
  CHECK(channel.move([](double) { return 0.49; }).closed > 0);
}

TEST_CASE("Contact opens where it presses less than the fluid would, and does not close again at once") {
  Channel channel(4);
  const std::int64_t closed = channel.move([](double) { return 0.1; }).closed;
  CHECK(channel.move([](double) { return 0.1; }).closed == closed);  // it presses more
  for (std::int32_t cell = 0; cell < channel.mesh.num_cells(); ++cell) {
    if (channel.mesh.point(channel.mesh.vertices_of(cell)[0])[0] < 1) channel.load.fluid_pressure[cell] = 2;
  }
  const ContactProposal half = channel.move([](double) { return 0.1; });
  CHECK(half.opening == Approx(0.5 * static_cast<double>(closed)).epsilon(0.15));
  std::fill(channel.load.normal_stress.begin(), channel.load.normal_stress.end(), -3.0);
  CHECK(channel.move([](double) { return 0.1; }).closing == 0);
  CHECK(channel.move([](double) { return 0.095; }).closing == 0);
  const ContactProposal again = channel.move([](double) { return 0.085; });
  CHECK(again.closing >= half.opening);
  CHECK(again.closed == closed);
}

TEST_CASE("A pocket between closed cells closes if it is narrow, a chamber does not") {
  Channel pocket(4), chamber(4);
  const std::int64_t all = base::sum(pocket.mesh.comm, static_cast<std::int64_t>(pocket.mesh.num_cells()));
  pocket.move([](double x) { return x < 0.5 || x > 1.5 ? 0.1 : 0.2; });
  CHECK(pocket.in_contact() == all);
  chamber.move([](double x) { return x < 0.5 || x > 1.5 ? 0.1 : 0.5; });
  CHECK(chamber.in_contact() > all / 3);
  CHECK(chamber.in_contact() < 2 * all / 3);
}

/// Contact cells beyond x = 1 when a channel that is closed up to x = 0.5 and wide from x = 1.5 on has a row of cells
/// of some height [m] at its top between.
std::int64_t in_contact_along(double height) {
  Channel channel(4);
  std::vector<double> coordinates = channel.squeezed([](double x) { return x < 0.55 ? 0.1 : x < 1.55 ? 0.2 : 1.0; });
  for (std::size_t i = 0; i < coordinates.size(); i += 2) {
    if (coordinates[i] < 0.55 || coordinates[i] > 1.55 || coordinates[i + 1] > 0.07) continue;
    coordinates[i + 1] *= (0.08 - height) / 0.06;
  }
  const ContactState state = channel.search.propose(coordinates, channel.state, channel.load).state;
  std::int64_t count = 0;
  for (std::int32_t cell = 0; cell < channel.mesh.num_cells(); ++cell) {
    double middle = 0;
    for (const std::int32_t v : channel.mesh.vertices_of(cell)) middle += coordinates[2 * v] / 3;
    count += state.in_contact[cell] && middle > 1;
  }
  return base::sum(channel.mesh.comm, count);
}

TEST_CASE("Beside contact only the next thin cells close, but nearly flat ones behind them, too") {
  CHECK(in_contact_along(0.004) == 0);
  CHECK(in_contact_along(0.001) >= 10);
}

TEST_CASE("The gap is measured again only when the walls may have come near") {
  Channel channel(4);
  channel.move([](double) { return 0.2; });  // gap 0.08, 0.03 from closing
  CHECK_FALSE(channel.search.is_due(channel.squeezed([](double) { return 0.19; })));
  CHECK(channel.search.is_due(channel.squeezed([](double) { return 0.17; })));
  channel.search.forget();
  CHECK(channel.search.is_due(channel.squeezed([](double) { return 0.2; })));
}

}  // namespace
}  // namespace vocalis::contact
