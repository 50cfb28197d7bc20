#include "fsi_solver/mesh_motion/mesh_follower.hpp"

#include <cmath>

#include "tests/all_ranks.hpp"
#include "tests/fsi_solver/room.hpp"

namespace vocalis::fsi {

namespace {

using test::largest_difference;
using test::Room;

FlowSettings nonlinear() {
  FlowSettings settings;
  settings.smoother = Smoother::nonlinear;
  settings.smoother_quality = 0.4;
  return settings;
}

/// The mesh with the block at an angle [degree], by the linear and by the non-linear smoother.
fem::Field linear_mesh(const Room& room, double angle) {
  fem::Field result = room.moved(angle, 0.1);
  MeshMotion(room.continuum, room.conditions, 1).extend(result);
  return result;
}

fem::Field nonlinear_mesh(const Room& room, double angle) {
  fem::Field result = room.moved(angle, 0.1);
  CHECK(NonlinearSmoother(room.continuum, room.conditions, 1).extend(result, room.at_rest()).converged);
  return result;
}

/// The mesh around a block that has been turned to an angle [degree] in steps of 4.
fem::Field wound_up(const Room& room, MeshFollower& follower, double angle) {
  fem::Field mesh = room.at_rest();
  for (int i = 1; i <= std::abs(angle) / 4; ++i) {
    mesh = room.moved(std::copysign(4.0 * i, angle), 0);
    follower.extend(mesh);
  }
  return mesh;
}

}  // namespace

TEST_CASE("the mesh is that of the linear smoother where this is good, of the non-linear one where it is bad") {
  const Room room(2, 12);
  base::Timers timers;
  MeshFollower follower(room.continuum, room.conditions, nonlinear(), timers);
  MeshFollower linear(room.continuum, room.conditions, FlowSettings(), timers);
  struct Position {
    double angle, least, most;  // quality of the linear mesh
  };
  for (const auto& [angle, least, most] : {Position{5, 0.4, 1}, {25, 0.2, 0.4}, {40, -1, 0.2}}) {
    const fem::Field one = linear_mesh(room, angle), other = nonlinear_mesh(room, angle);
    INFO("angle " << angle << " quality " << room.quality(one));
    CHECK(room.quality(one) > least);
    CHECK(room.quality(one) < most);
    fem::Field mesh = room.moved(angle, 0.1), same = mesh;
    follower.extend(mesh);
    linear.extend(same);
    CHECK(largest_difference(same, one) == 0);
    CHECK((largest_difference(mesh, one) == 0) == (least == 0.4));
    CHECK((largest_difference(mesh, other) < 1e-8) == (most == 0.2));
    CHECK(room.quality(mesh) > 0.1);
  }
}

TEST_CASE("between the smoothers the mesh moves without a jump, and comes back") {
  const Room room(2, 12);
  base::Timers timers;
  MeshFollower follower(room.continuum, room.conditions, nonlinear(), timers);
  std::vector<fem::Field> there;
  double fastest = 0;
  const auto mesh_at = [&](int angle) {
    fem::Field mesh = room.moved(angle, 0.1);
    follower.extend(mesh);
    return mesh;
  };
  for (int angle = 0; angle <= 40; ++angle) {
    there.push_back(mesh_at(angle));
    if (angle > 0) fastest = std::max(fastest, largest_difference(there[angle], there[angle - 1]));
  }
  // In a degree, meshes of one smoother move by 0.016 m at most; a switch between them would jump by 0.05 m.
  CHECK(fastest < 0.025);
  CHECK(largest_difference(linear_mesh(room, 25), nonlinear_mesh(room, 25)) > 0.05);
  for (int angle = 40; angle >= 0; --angle) CHECK(largest_difference(mesh_at(angle), there[angle]) < 1e-8);
}

TEST_CASE("a step that begins anew leaves no trace of one that was given up") {
  const Room room(2, 12);
  base::Timers timers;
  MeshFollower one(room.continuum, room.conditions, nonlinear(), timers),
      other(room.continuum, room.conditions, nonlinear(), timers);
  fem::Field before = nonlinear_mesh(room, 38), given_up = room.moved(50, -0.2);
  fem::Field here = room.moved(40, 0.1), there = here;
  one.begin_step(before, {});
  one.extend(given_up);
  one.begin_step(before, {});
  one.drop_factors();
  one.extend(here);
  other.begin_step(before, {});
  other.extend(there);
  CHECK(here.values == there.values);
}

TEST_CASE("a mesh on its way back to where the smoother had it is searched for there, not at another minimum") {
  const Room room(2, 12);
  base::Timers timers;
  MeshFollower follower(room.continuum, room.conditions, nonlinear(), timers);
  const fem::Field left = wound_up(room, follower, 180);
  follower.begin_step(room.at_rest(), {});
  const fem::Field right = wound_up(room, follower, -180);
  CHECK(room.quality(left) > 0);
  CHECK(room.quality(right) > 0);
  CHECK(largest_difference(left, right) > 1);
  std::vector<double> offset = left.values;
  for (std::size_t i = 0; i < offset.size(); ++i) offset[i] -= right.values[i];
  fem::Field mesh = room.moved(180, 0);
  follower.begin_step(left, {});
  follower.extend(mesh);
  CHECK(largest_difference(mesh, left) < 1e-8);
  follower.begin_step(left, offset);
  follower.extend(mesh);
  CHECK(largest_difference(mesh, right) < 1e-8);
}

TEST_CASE("where the non-linear smoother finds no mesh the inverted one of the linear smoother stays") {
  const Room room(2, 6);
  base::Timers timers;
  MeshFollower follower(room.continuum, room.conditions, nonlinear(), timers);
  fem::Field mesh = room.moved(0, 1.2), linear = mesh;
  follower.extend(mesh);
  MeshMotion(room.continuum, room.conditions, 1).extend(linear);
  CHECK(largest_difference(mesh, linear) == 0);
  fem::Field possible = room.moved(0, 0.6);
  follower.extend(possible);
  CHECK(room.quality(possible) > 0);
}

}  // namespace vocalis::fsi
