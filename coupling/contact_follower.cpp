#include "coupling/contact_follower.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/mpi.hpp"
#include "core/base/stopwatch.hpp"
#include "core/mesh/facets.hpp"
#include "core/mesh/geometry.hpp"
#include "fsi_solver/continuum.hpp"
#include "fsi_solver/measures/contact_load.hpp"

namespace vocalis::coupling {

namespace {

constexpr double too_deep = 0.5;  ///< of the gap at which a cell is to close

std::vector<char> fluid_cells_with_ghosts(const fsi::FsiSolver& flow) {
  const mesh::Mesh& mesh = *flow.continuum().mesh;
  std::vector<char> region_is_fluid(mesh.region_names.size(), 1);
  for (const fsi::SolidMaterial& solid : flow.settings().solids) {
    region_is_fluid[mesh::index_of(mesh.region_names, solid.region)] = 0;
  }
  std::vector<char> result(mesh.cell_region.size());
  for (std::size_t cell = 0; cell < result.size(); ++cell) result[cell] = region_is_fluid[mesh.cell_region[cell]];
  return result;
}

const fsi::FlowBoundary* boundary_of(const fsi::FsiSolver& flow, std::int32_t group) {
  if (group < 0) return nullptr;
  const std::string& name = flow.continuum().mesh->group_names[group];
  for (const fsi::FlowBoundary& boundary : flow.settings().boundaries) {
    if (boundary.group == name) return &boundary;
  }
  return nullptr;
}

/// Solids, walls, and the end of the mesh where no boundary says otherwise.
std::vector<mesh::NamedFacet> walls_of(const fsi::FsiSolver& flow, std::span<const char> cell_is_fluid) {
  const mesh::Mesh& mesh = *flow.continuum().mesh;
  std::vector<mesh::NamedFacet> walls = contact::wall_facets(mesh, cell_is_fluid, {});
  for (const mesh::NamedFacet& facet : mesh::boundary_facets(mesh)) {
    const fsi::FlowBoundary* boundary = boundary_of(flow, facet.group);
    const bool is_wall = !boundary || boundary->kind == fsi::FlowBoundaryKind::wall;
    if (is_wall && cell_is_fluid[facet.cell]) walls.push_back(facet);
  }
  return walls;
}

std::vector<contact::SymmetryPlane> planes_of(const fsi::FsiSolver& flow) {
  const mesh::Mesh& mesh = *flow.continuum().mesh;
  std::vector<double> mine;  // axis, position
  for (const mesh::NamedFacet& facet : mesh::boundary_facets(mesh)) {
    const fsi::FlowBoundary* boundary = boundary_of(flow, facet.group);
    if (!boundary || boundary->kind != fsi::FlowBoundaryKind::symmetry) continue;
    const auto normal = mesh::facet_geometry(mesh, facet.cell, facet.index).normal;
    const auto steepest =
        std::max_element(normal.begin(), normal.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    const auto axis = steepest - normal.begin();
    mine.push_back(static_cast<double>(axis));
    mine.push_back(mesh.point(mesh::facet_vertices(mesh, facet.cell, facet.index)[0])[axis]);
  }
  const std::vector<double> all = base::concatenate_all(mesh.comm, mine);
  std::vector<contact::SymmetryPlane> planes;
  for (std::size_t i = 0; i < all.size(); i += 2) {
    const contact::SymmetryPlane plane = {static_cast<int>(all[i]), all[i + 1]};
    const auto is_same = [&](const contact::SymmetryPlane& other) {
      return other.axis == plane.axis && std::abs(other.position - plane.position) < 1e-9;
    };
    if (std::none_of(planes.begin(), planes.end(), is_same)) planes.push_back(plane);
  }
  return planes;
}

contact::ContactSearch make_search(const fsi::FsiSolver& flow, const contact::ContactSettings& settings) {
  const std::vector<char> is_fluid = fluid_cells_with_ghosts(flow);
  return {*flow.continuum().mesh, is_fluid, walls_of(flow, is_fluid), planes_of(flow), settings};
}

}  // namespace

ContactFollower::ContactFollower(fsi::FsiSolver& flow, const contact::ContactSettings& settings)
    : flow_(flow), search_(make_search(flow, settings)), state_(search_.open_state()) {
  // Walls that touch at rest.
  const auto proposal = search_.propose(flow.current_coordinates(), state_, {});
  state_ = proposal.state;
}

void ContactFollower::begin_step() {
  const base::Stopwatch watch;
  const MPI_Comm comm = flow_.continuum().mesh->comm;
  std::vector<char> now = flow_.state().in_contact;
  now.resize(state_.in_contact.size(), 0);
  const auto count = [&](const std::vector<char>& marks) {
    return base::sum(comm, static_cast<std::int64_t>(std::count(marks.begin(), marks.end(), 1)));
  };
  if (base::largest(comm, static_cast<std::int32_t>(now != state_.in_contact)) > 0) {
    report_.energy_lost += flow_.set_contact(state_.in_contact, state_.normal);
  }
  is_closed_ = count(state_.in_contact) > 0;
  report_.closed_steps += is_closed_;
  seconds_ = watch.seconds();
}

ContactFollower::Verdict ContactFollower::judge_step() {
  const base::Stopwatch watch;
  const std::vector<double> coordinates = flow_.tried_coordinates();
  proposal_.reset();
  if (!search_.is_due(coordinates)) {
    seconds_ += watch.seconds();
    return {};
  }
  ++report_.searches;
  const fsi::ContactLoad load = fsi::contact_load(flow_, state_.normal);
  proposal_ =
      search_.propose(coordinates, state_, {load.normal_stress, load.fluid_pressure, load.lowest_fluid_pressure});
  seconds_ += watch.seconds();
  return {proposal_->depth < too_deep, proposal_->reason};
}

void ContactFollower::accept() {
  if (!proposal_) return;
  report_.closings += proposal_->closing > 0;
  report_.most_closed = std::max(report_.most_closed, static_cast<double>(proposal_->closed));
  state_ = std::move(proposal_->state);
  proposal_.reset();
}

void ContactFollower::count_step(double seconds) {
  (is_closed_ ? report_.seconds_closed : report_.seconds_open) += seconds_;
  (is_closed_ ? report_.step_seconds_closed : report_.step_seconds_open) += seconds;
}

void ContactFollower::drop_caches() { search_.forget(); }

void ContactFollower::set_state(const contact::ContactState& state, const ContactReport& report) {
  state_ = state;
  report_ = report;
}

}  // namespace vocalis::coupling
