#include "coupling/case/case.hpp"
#include "tests/all_ranks.hpp"
#include "tests/coupling/case/case_folder.hpp"

using namespace vocalis;
using namespace vocalis::coupling;
using Catch::Matchers::Contains;
using test::Folder, test::message_of;

TEST_CASE("each kind of monitor takes its own keys") {
  const Folder folder;
  const std::string text = R"([case]
name = "monitors"
[mesh]
geometry = "example.geo"
[[region]]
name = "bar"
kind = "solid"
young_modulus = 1.4e6
[flow]
gravity = [0, -2]
[time]
end = 1
dt = 0.1
[[monitor]]
name = "tip"
kind = "displacement"
position = [0.6, 0.2]
[[monitor]]
name = "front"
kind = "pressure"
position = [0.15, 0.2]
[[monitor]]
name = "fall"
kind = "pressure_difference"
position = [0.15, 0.2]
other = [0.25, 0.2]
[[monitor]]
kind = "energy"
[[monitor]]
name = "flag"
kind = "force"
groups = ["flag"]
)";
  const Case config = read_case(MPI_COMM_WORLD, folder.write(text), {});
  REQUIRE(config.monitors.size() == 5);
  CHECK(config.monitors[1].position == std::array<double, 3>{0.15, 0.2, 0});
  CHECK(config.monitors[2].other == std::array<double, 3>{0.25, 0.2, 0});
  CHECK(config.monitors[3].kind == MonitorKind::energy);
  CHECK(config.monitors[4].reference_force == 0);
  const std::vector<std::string> names = {
      "tip_x_m",           "tip_y_m",          "front_Pa",         "fall_Pa",
      "energy_kinetic_J",  "energy_elastic_J", "power_supplied_W", "power_dissipated_W",
      "energy_residual_J", "flag_drag_N",      "flag_lift_N"};
  std::vector<std::string> found;
  for (const MonitorSettings& monitor : config.monitors) {
    for (const MonitorColumn& column : columns_of(monitor, 2)) found.push_back(column.name());
  }
  CHECK(found == names);
  CHECK_THAT(message_of(folder, text, {"flow.smoother=nonlinear"}), Contains("no region of kind \"fluid\""));
  CHECK_THAT(message_of(folder, text, {"monitor.front.other=[0, 0]"}), Contains("not a key"));
  CHECK_THAT(message_of(folder, text, {"monitor.flag.groups=flag"}), Contains("an array of texts"));
}

TEST_CASE("a glottis lies between two folds, or between one and a plane") {
  const Folder folder;
  const std::string text = R"([case]
name = "glottis"
[mesh]
geometry = "example.geo"
[[region]]
name = "air"
kind = "fluid"
[flow]
[time]
end = 1
dt = 0.1
[[monitor]]
name = "half"
kind = "glottis"
group = "fold"
mirrored = true
depth = 0.015
[[monitor]]
name = "whole"
kind = "glottis"
group = "left"
other_group = "right"
axis = "x"
along = "z"
stations = 30
[output]
kymogram_interval = 2e-4
)";
  const Case config = read_case(MPI_COMM_WORLD, folder.write(text), {});
  REQUIRE(config.monitors.size() == 2);
  CHECK(config.monitors[0].axis == 1);
  CHECK(config.monitors[0].along == 0);
  CHECK(config.monitors[0].mirrored);
  CHECK(config.monitors[0].depth == 0.015);
  CHECK(config.monitors[1].other_group == "right");
  CHECK(config.monitors[1].axis == 0);
  CHECK(config.monitors[1].along == 2);
  CHECK(config.monitors[1].stations == 30);
  CHECK(config.output.kymogram_interval == 2e-4);
  const Case again = read_case(MPI_COMM_WORLD, folder.write(config.resolved), {});
  CHECK(again.monitors[0].mirrored);
  CHECK(again.monitors[1].other_group == "right");
  CHECK(again.monitors[1].along == 2);
  CHECK_THAT(message_of(folder, text, {"monitor.whole.mirrored=true"}), Contains("a second fold, or a plane"));
  CHECK_THAT(message_of(folder, text, {"monitor.half.along=y"}), Contains("another axis"));
  CHECK_THAT(message_of(folder, text, {"monitor.half.stations=1"}), Contains("from 2 to 10000"));
}
