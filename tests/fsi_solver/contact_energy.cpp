// What contact does to the energy, counted as the time scheme counts: closing, being closed and opening make none.
#include <algorithm>
#include <cmath>

#include "fsi_solver/measures/energy.hpp"
#include "fsi_solver/measures/energy_balance.hpp"
#include "fsi_solver/solution/assembly.hpp"
#include "tests/all_ranks.hpp"
#include "tests/fsi_solver/contact_blocks.hpp"

namespace vocalis::fsi {
namespace {

/// Two free blocks with air between and beside them.
FlowSettings blocks_in_air(Elements elements) {
  FlowSettings flow = test::free_blocks(elements);
  for (FlowBoundary& boundary : flow.boundaries) boundary.kind = FlowBoundaryKind::outlet;
  return flow;
}

/// Of the layer, those that are less than this far from the middle [m].
std::vector<char> middle_cells(const FsiSolver& solver, double reach) {
  const mesh::Mesh& mesh = *solver.continuum().mesh;
  std::vector<char> marks = test::cells_between(solver);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    double middle = 0;
    for (const std::int32_t v : mesh.vertices_of(cell)) middle += mesh.point(v)[0] / 3;
    marks[cell] = marks[cell] && std::abs(middle - 0.005) < reach;
  }
  return marks;
}

/// The energy kept less the work, from step to step, over that after the first step.
class Account {
 public:
  explicit Account(const FsiSolver& solver) : solver_(solver), open_(find_open_facets(solver)) {}

  void follow_step() {
    const EnergyRates rates = energy(solver_, open_);
    balance_.advance(solver_.assembly().fields().stage(), rates);
    const double left = balance_.left();
    if (first_ == 0) first_ = lowest_ = left;
    rise_ = std::max(rise_, left - lowest_);
    lowest_ = std::min(lowest_, left);
    stored_ = std::max(stored_, rates.elastic);
  }
  double rise() const { return rise_ / first_; }               ///< the largest above where it has been
  double lost() const { return (first_ - lowest_) / first_; }  ///< until now
  double stored() const { return stored_ / first_; }           ///< the most elastic energy

 private:
  const FsiSolver& solver_;
  OpenFacets open_;
  EnergyBalance balance_;
  double first_ = 0, lowest_ = 0, rise_ = 0, stored_ = 0;
};

void take_steps(FsiSolver& solver, double dt, int steps, Account& account) {
  for (int step = 0; step < steps; ++step) {
    const StepReport report = solver.try_step(dt);
    INFO("step " << step << " " << report.reason);
    REQUIRE_ON_ALL_RANKS(report.converged);
    solver.accept();
    account.follow_step();
  }
}

}  // namespace

TEST_CASE("A contact with air beside it makes no energy") {
  for (const Elements elements : {Elements::p1p1, Elements::p2p1}) {
    const mesh::Mesh mesh = test::blocks();
    const double dt = 5e-5;
    FsiSolver solver(mesh, blocks_in_air(elements), {.end = 1, .step = dt});
    solver.set_contact(middle_cells(solver, 0.003));
    test::start(solver, 0.05);
    Account account(solver);
    take_steps(solver, dt, 200, account);
    INFO("rise " << account.rise() << " lost " << account.lost() << " stored " << account.stored());
    CHECK(account.rise() < 1e-9);
  }
}

TEST_CASE("Cells that close and open make no energy") {
  for (const Elements elements : {Elements::p1p1, Elements::p2p1}) {
    for (const double dt : {2e-4, 1e-4}) {
      const mesh::Mesh mesh = test::blocks();
      FsiSolver solver(mesh, blocks_in_air(elements), {.end = 1, .step = dt});
      test::start(solver, 0.05);
      Account account(solver);
      for (const double reach : {0.0, 0.002, 0.004, 0.01, 0.003, 0.0}) {
        solver.set_contact(middle_cells(solver, reach));
        take_steps(solver, dt, static_cast<int>(std::lround(2e-3 / dt)), account);
      }
      INFO("rise " << account.rise() << " lost " << account.lost() << " stored " << account.stored());
      CHECK(account.rise() < 1e-9);
      CHECK(account.stored() > 0.3);
    }
  }
}

}  // namespace vocalis::fsi
