#include "coupling/flow/flow_history.hpp"

#include "core/base/mpi.hpp"
#include "core/mesh/facets.hpp"
#include "coupling/flow/solved_flow.hpp"
#include "tests/all_ranks.hpp"
#include "tests/coupling/small_scene.hpp"

using namespace vocalis;
using namespace vocalis::coupling;

namespace {

/// A slit between two blocks that ends in air.
std::unique_ptr<Scene> slit() {
  return test::box_scene({0.02, 0.01, 0}, {16, 10, 0}, [](const auto& x) {
    if (x[0] > 0.015) return RegionKind::air;
    return x[1] < 0.004 || x[1] > 0.006 ? RegionKind::solid : RegionKind::fluid;
  });
}

fsi::FlowSettings settings() {
  fsi::FlowSettings flow;
  flow.solids.emplace_back();
  flow.solids.back().region = "solid";
  flow.solids.back().young_modulus = 2000;
  flow.boundaries = {{.group = "bottom", .kind = fsi::FlowBoundaryKind::fixed},
                     {.group = "top", .kind = fsi::FlowBoundaryKind::fixed}};
  flow.contact = fsi::ContactMedium{.young_modulus = 2000, .damping = 2};
  return flow;
}

using Marks = std::vector<std::int32_t>;

}  // namespace

TEST_CASE("cells in contact emit nothing, nor in the step after they have opened") {
  const auto scene = slit();
  const mesh::Mesh& mesh = scene->flow->mesh;
  fsi::FsiSolver flow(mesh, settings(), {.end = 1, .step = 1e-4});
  const SolvedFlow solved(*scene, flow);
  FlowHistory history(*scene, snapshots_for(PressureDerivative::step), true);
  history.restart(solved.snapshot());
  const Marks all = fluid_cells(*scene), none(mesh.num_vertices(), 0);
  Marks others = all, closed(mesh.num_cells(), 0);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const double x = mesh.point(mesh.vertices_of(cell)[0])[0];
    if (all[cell] == 0 || x < 0.005 || x > 0.01) continue;
    others[cell] = 0;
    closed[cell] = 1;
  }
  CHECK(base::largest(MPI_COMM_WORLD, static_cast<std::int32_t>(others != all)) == 1);
  const Marks silent = mesh::mark_vertices_of_cells(mesh, closed);
  const auto step_with = [&](const Marks& marks, const Marks& emitting, const Marks& silence) {
    flow.set_contact(std::vector<char>(marks.begin(), marks.end()));
    history.add(solved.snapshot());
    const FlowView view = history.step(PressureDerivative::step).view;
    CHECK(view.cell_is_fluid == emitting);
    CHECK(view.vertex_is_silent == silence);
  };
  const Marks open(mesh.num_cells(), 0);
  step_with(open, all, none);
  step_with(closed, others, silent);
  step_with(closed, others, silent);
  step_with(open, others, silent);
  step_with(open, all, none);
}
