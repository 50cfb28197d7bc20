#include "coupling/case/case.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/io/wav.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;
using namespace vocalis::coupling;
using Catch::Matchers::Contains;

namespace {

const char* const example = R"([case]
name = "example"
[mesh]
geometry = "example.geo"
[mesh.parameters]
half_gap = 2.5e-4
areas = [0.33, 2]
[[region]]
name = "air"
kind = "fluid"
[[region]]
name = "fold"
kind = "solid"
young_modulus = 5000
poisson_ratio = 0.45
[flow]
density = 1.14
[[flow.boundary]]
group = "inlet"
kind = "pressure"
pressure = 800
ramp = 0.01
[[flow.boundary]]
group = "sides"
kind = "velocity"
velocity = [1, 0]
period = 16
[time]
end = 0.1
dt = 1e-5
[[acoustic]]
name = "near"
[[acoustic.boundary]]
group = "open"
kind = "open"
radius = 0.05
[[acoustic]]
name = "far"
analogy = "none"
dt = 2e-6
[[microphone]]
name = "mouth"
position = [0.2, 0]
[[monitor]]
name = "gap"
kind = "gap"
group = "surface"
axis = "y"
[[monitor]]
kind = "force"
groups = ["sides", "surface"]
reference_force = 20
[[monitor]]
name = "across"
kind = "flux"
from = [0, 0]
to = [0, 1]
[statistics]
kind = "periodic"
period_of = "lift_coefficient"
begin = 0.05
[expected]
f0_Hz = { value = 120, tolerance = 5, source = "a measurement", spread = 2 }
)";

/// A folder with a case file and its geometry, the same on all ranks.
class Folder {
 public:
  Folder() : path_("/tmp/vocalis_case_" + std::to_string(base::size(MPI_COMM_WORLD))) {
    if (base::rank(MPI_COMM_WORLD) == 0) {
      std::filesystem::create_directories(path_);
      std::ofstream(path_ + "/example.geo") << "// empty\n";
    }
  }
  ~Folder() {
    MPI_Barrier(MPI_COMM_WORLD);
    if (base::rank(MPI_COMM_WORLD) == 0) std::filesystem::remove_all(path_);
  }
  std::string write(const std::string& text) const {
    if (base::rank(MPI_COMM_WORLD) == 0) std::ofstream(path_ + "/case.toml") << text;
    return path_ + "/case.toml";
  }
  std::string path() const { return path_; }

 private:
  std::string path_;
};

std::string message_of(const Folder& folder, const std::string& text, const std::vector<std::string>& overrides) {
  try {
    read_case(MPI_COMM_WORLD, folder.write(text), overrides);
  } catch (const base::UserError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

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

TEST_CASE("a prescribed source needs no flow and gives the acoustic solvers a flux boundary") {
  const Folder folder;
  const std::string text = R"([case]
name = "pulse"
[mesh]
geometry = "example.geo"
[[region]]
name = "tract"
kind = "air"
[source]
kind = "gaussian_pulse"
group = "glottis"
[[acoustic]]
dt = 1e-6
[time]
end = 0.02
)";
  const Case config = read_case(MPI_COMM_WORLD, folder.write(text), {});
  CHECK_FALSE(config.flow.has_value());
  CHECK(config.time.step == 1e-6);
  CHECK(config.acoustics[0].analogy.name == "none");
  REQUIRE(config.acoustics[0].boundaries.size() == 1);
  CHECK(config.acoustics[0].boundaries[0].kind == acoustic::AcousticBoundaryKind::flux);
  CHECK(config.resolved.find("viscosity") == std::string::npos);
  CHECK_THAT(message_of(folder, text, {"acoustic.analogy=pressure_rate"}), Contains("needs a flow"));
}

TEST_CASE("a source is a pulse of one of four kinds, a signal of a file among them") {
  const Folder folder;
  const std::string text = R"([case]
name = "voice"
[mesh]
geometry = "example.geo"
[[region]]
name = "tract"
kind = "air"
[source]
kind = "rosenberg"
group = "glottis"
open_quotient = 0.7
[[acoustic]]
dt = 1e-6
[time]
end = 0.02
)";
  const Case rosenberg = read_case(MPI_COMM_WORLD, folder.write(text), {});
  const auto* pulse = std::get_if<acoustic::RosenbergPulse>(&rosenberg.source->pulse);
  REQUIRE(pulse);
  CHECK(pulse->open_quotient == 0.7);
  CHECK_THAT(rosenberg.resolved, Contains("speed_quotient = 2.5"));

  std::string other = text;
  other.replace(other.find("rosenberg"), 9, "signal");
  other.replace(other.find("open_quotient = 0.7"), 19, "file = \"flow.csv\"\nscale = 2\nfade = 1e-3");
  CHECK_THAT(message_of(folder, other, {}), Contains("source.file") && Contains("flow.csv"));
  if (base::rank(MPI_COMM_WORLD) == 0) {
    std::ofstream(folder.path() + "/flow.csv") << "time_s,flow\n0,1\n0.001,2\n0.002,3\n0.003,2\n0.004,1\n";
    std::vector<double> sound(41);
    for (int n = 0; n <= 40; ++n) sound[n] = std::pow(std::sin(0.025 * M_PI * n), 4);
    io::write_wav(folder.path() + "/flow.wav", sound, {.sampling_rate = 8000});
  }
  MPI_Barrier(MPI_COMM_WORLD);
  const Case table = read_case(MPI_COMM_WORLD, folder.write(other), {});
  const auto* signal = std::get_if<acoustic::RecordedSignal>(&table.source->pulse);
  REQUIRE(signal);
  CHECK(signal->values == std::vector<double>{2, 4, 6, 4, 2});
  CHECK(signal->fade == 1e-3);
  CHECK_THAT(table.resolved, Contains(folder.path() + "/flow.csv") && Contains("m/s per unit of the file"));

  const Case sound = read_case(MPI_COMM_WORLD, folder.write(other), {"source.file=flow.wav", "source.fade=0"});
  signal = std::get_if<acoustic::RecordedSignal>(&sound.source->pulse);
  REQUIRE(signal);
  CHECK(signal->times.size() == 161);
  CHECK(signal->times.back() == Approx(40.0 / 8000));
  CHECK(signal->values[80] == Approx(2).epsilon(1e-4));
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

TEST_CASE("a case that contradicts itself is refused with the rule and a remedy") {
  const Folder folder;
  const std::vector<std::pair<std::string, std::string>> mistakes = {
      {"region.air.kind=air", "needs a region of fluid"},
      {"region.fold.poisson_ratio=0.5", "incompressible = true"},
      {"region.fold.incompressible=true", "is 0.5"},
      {"region.name=air", "a name of its own"},
      {"acoustic.name=one", "a name of its own"},
      {"acoustic.analogy=pressure_rat", "did you mean \"pressure_rate\""},
      {"time.dt=1", "not be larger than time.end"},
      {"time.scheme=euler", "one of theta, bdf2"},
      {"flow.densty=1", "did you mean \"density\""},
      {"microphone.mouth.position=[1]", "2 to 3 numbers"},
      {"microphone.name=a,b", "letters, digits"},
      {"mesh.geometry=nothing.geo", "a file that can be read"},
      {"mesh.file=nothing.msh", "one of geometry and file"},
      {"source.kind=lf", "group is needed"},
      {"monitor.kind=gab", "did you mean \"gap\""},
      {"monitor.across.group=sides", "a group, or a line"},
      {"monitor.across.to=[0, 0]", "another point"},
      {"monitor.across.name=gap", "a name of its own"},
      {"statistics.kind=mean", "last, periodic, extrema"},
      {"statistics.begin=0.1", "earlier than time.end"},
      {"statistics.kind=last", "not a key"},
      {"flow.elements=P2P2", "one of P1P1, P2P1"},
      {"flow.geometry=fixed", "implicit, explicit"},
      {"flow.smoother=none", "linear, nonlinear"},
      {"flow.smoother_quality=2", "from 0 to 1"},
      {"flow.boundary.inlet.period=-1", "zero or positive"},
      {"flow.boundary.sides.period=-1", "zero or positive"},
      {"time.tolerance=-1", "from 0 to 1"},
      {"time.largest_dt=1e-6", "not be smaller than time.dt"},
      {"expected.f0_Hz.spread=-1", "zero or positive"},
      {"expected.f0_Hz.tolerance=0", "positive"}};
  for (const auto& [override, words] : mistakes) {
    INFO(override);
    const std::string message = message_of(folder, example, {override});
    CHECK_THAT(message, Contains(words) && Contains("found: ") && Contains("remedy: "));
    CHECK_THAT(message, Contains("case.toml") || Contains("--set " + override));
  }
}

TEST_CASE("names that the mesh lacks are refused with their place and the nearest name") {
  const Folder folder;
  const Case config = read_case(MPI_COMM_WORLD, folder.write(example), {});
  const std::vector<std::string> regions = {"air", "fold"};
  const std::vector<std::string> groups = {"inlet", "sides", "open", "surface"};
  CHECK_NOTHROW(check_case_against_mesh_names(config, 2, regions, groups));
  const auto message = [&](int dimension, const std::vector<std::string>& r, const std::vector<std::string>& g) {
    try {
      check_case_against_mesh_names(config, dimension, r, g);
    } catch (const base::UserError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  CHECK_THAT(message(2, {"air", "folds"}, groups),
             Contains("case.toml:12: region[fold].name") && Contains("\"folds\""));
  CHECK_THAT(message(2, regions, {"inlett", "sides", "open", "surface"}),
             Contains("flow.boundary[inlet].group") && Contains("did you mean \"inlett\""));
  CHECK_THAT(message(2, {"air", "fold", "room"}, groups), Contains("nothing about \"room\""));
  CHECK_THAT(message(2, regions, {}), Contains("no named groups"));
  CHECK_THAT(message(3, regions, groups), Contains("3 components"));
}
