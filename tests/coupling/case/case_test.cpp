#include "coupling/case/case.hpp"

#include "tests/all_ranks.hpp"
#include "tests/coupling/case/case_folder.hpp"

using namespace vocalis;
using namespace vocalis::coupling;
using Catch::Matchers::Contains;
using test::Folder, test::message_of, test::example;

TEST_CASE("a case file becomes settings, with the defaults of the structs") {
  const Folder folder;
  const Case config = read_case(MPI_COMM_WORLD, folder.write(example), {});
  CHECK(config.name == "example");
  CHECK(config.mesh.is_geometry);
  CHECK(config.mesh.file == folder.path() + "/example.geo");
  CHECK(std::get<double>(config.mesh.parameters.at("half_gap")) == 2.5e-4);
  CHECK(std::get<std::vector<double>>(config.mesh.parameters.at("areas")) == std::vector<double>{0.33, 2});
  REQUIRE(config.flow.has_value());
  CHECK(config.flow->density == 1.14);
  CHECK(config.flow->viscosity == fsi::FlowSettings().viscosity);
  REQUIRE(config.flow->solids.size() == 1);
  CHECK(config.flow->solids[0].region == "fold");
  CHECK(config.flow->solids[0].young_modulus == 5000);
  REQUIRE(config.flow->boundaries.size() == 2);
  CHECK(config.flow->boundaries[0].pressure == 800);
  CHECK(config.flow->boundaries[1].velocity == std::array<double, 3>{1, 0, 0});
  REQUIRE(config.acoustics.size() == 2);
  CHECK(config.acoustics[0].analogy.name == "pressure_rate");
  CHECK(config.acoustics[0].step == config.time.step);
  CHECK(config.acoustics[1].step == 2e-6);
  CHECK(config.acoustics[0].boundaries[0].radius == 0.05);
  CHECK(config.microphones[0].position == std::array<double, 3>{0.2, 0, 0});
  CHECK(config.monitors[0].axis == 1);
  CHECK(config.output.directory == "runs/example");
  CHECK(config.expected.at("f0_Hz").tolerance == 5);
}

TEST_CASE("what a case says about elements, mesh motion, step and statistics becomes settings") {
  const Folder folder;
  const Case usual = read_case(MPI_COMM_WORLD, folder.write(example), {});
  CHECK(usual.flow->elements == fsi::Elements::p1p1);
  CHECK(usual.flow->boundaries[1].period == 16);
  const Case pulsating = read_case(MPI_COMM_WORLD, folder.write(example), {"flow.boundary.inlet.period=0.5"});
  CHECK(pulsating.flow->boundaries[0].period == 0.5);
  CHECK(usual.time.tolerance == 0);
  REQUIRE(usual.monitors.size() == 3);
  CHECK(usual.monitors[1].name.empty());
  CHECK(usual.monitors[1].groups == std::vector<std::string>{"sides", "surface"});
  CHECK(usual.monitors[1].reference_force == 20);
  CHECK(usual.monitors[2].to == std::array<double, 3>{0, 1, 0});
  REQUIRE(usual.statistics.has_value());
  CHECK(usual.statistics->kind == StatisticsKind::periodic);
  CHECK(usual.statistics->period_of == "lift_coefficient");
  CHECK(usual.statistics->begin == 0.05);
  CHECK(usual.expected.at("f0_Hz").spread == 2);
  CHECK_THAT(usual.resolved, Contains("pressure_stabilisation = true  # default"));

  const Case chosen = read_case(
      MPI_COMM_WORLD, folder.write(example),
      {"flow.elements=P2P1", "flow.geometry=explicit", "flow.streamline_stabilisation=false", "flow.smoother=nonlinear",
       "flow.smoother_quality=0.2", "time.tolerance=1e-3", "time.largest_dt=1e-3"});
  CHECK(chosen.flow->elements == fsi::Elements::p2p1);
  CHECK(chosen.flow->geometry == fsi::Geometry::explicit_);
  CHECK_FALSE(chosen.flow->streamline_stabilisation);
  CHECK(chosen.flow->smoother == fsi::Smoother::nonlinear);
  CHECK(chosen.flow->smoother_quality == 0.2);
  CHECK(chosen.time.tolerance == 1e-3);
  CHECK(chosen.time.largest_step == 1e-3);
  CHECK(chosen.resolved.find("pressure_stabilisation") == std::string::npos);
}

TEST_CASE("contact has friction unless a case says that it slides, on a film that follows its damping") {
  const Folder folder;
  const std::string sticks = std::string(example) + "[contact]\ndamping = 3\n";
  const Case with_friction = read_case(MPI_COMM_WORLD, folder.write(sticks), {});
  REQUIRE(with_friction.flow->contact.has_value());
  CHECK(with_friction.flow->contact->friction == fsi::Friction::full);
  const Case slides = read_case(MPI_COMM_WORLD, folder.write(sticks + "friction = \"none\"\n"), {});
  CHECK(slides.flow->contact->friction == fsi::Friction::none);
  CHECK(slides.flow->contact->film_viscosity == Approx(0.15));
  const Case undamped = read_case(MPI_COMM_WORLD, folder.path() + "/case.toml", {"contact.damping=0"});
  CHECK(undamped.flow->contact->film_viscosity == undamped.flow->viscosity);
  CHECK_THAT(message_of(folder, sticks + "friction = \"some\"\n", {}), Contains("full"));
}

TEST_CASE("the resolved case reads as the same case") {
  const Folder folder;
  const Case config = read_case(MPI_COMM_WORLD, folder.write(example), {"time.dt=5e-6", "acoustic.far.density=1.1"});
  const std::string path = folder.path() + "/resolved.toml";
  write_resolved(MPI_COMM_WORLD, config, path);
  const Case again = read_case(MPI_COMM_WORLD, path, {});
  CHECK(again.time.step == 5e-6);
  CHECK(again.acoustics[1].density == 1.1);
  CHECK(again.mesh.file == config.mesh.file);
  CHECK(again.flow->newton_tolerance == config.flow->newton_tolerance);
  CHECK_THAT(config.resolved, Contains("pressure = 800  # [Pa]") && Contains("# [s] default"));
  CHECK_THROWS_AS(write_resolved(MPI_COMM_WORLD, config, "/nowhere/resolved.toml"), base::UserError);
}

TEST_CASE("several analogies in one table are as many voices") {
  const Folder folder;
  const std::string several = "acoustic.0.analogy=[\"pcwe\", \"lighthill\"]";
  const Case config = read_case(MPI_COMM_WORLD, folder.write(example), {several, "acoustic.0.mean_flow=true"});
  REQUIRE(config.acoustics.size() == 3);
  const auto& pcwe = config.acoustics[0];
  CHECK(pcwe.name == config.acoustics[1].name.substr(0, config.acoustics[1].name.find('_')) + "_pcwe");
  CHECK(pcwe.analogy.name == "pcwe");
  CHECK(pcwe.analogy.mean_time == Approx(config.time.end / 10));
  CHECK(config.acoustics[1].analogy.name == "lighthill");
  CHECK(config.acoustics[1].boundaries.size() == pcwe.boundaries.size());
  CHECK(config.acoustics[2].name.find('_') == std::string::npos);
  CHECK_THAT(message_of(folder, example, {"acoustic.0.analogy=[\"pcwe\", \"lighthil\"]"}),
             Contains("did you mean \"lighthill\""));
  CHECK_THAT(message_of(folder, example, {"acoustic.0.analogy=[\"pcwe\", \"pcwe\"]"}), Contains("a name of its own"));
}
