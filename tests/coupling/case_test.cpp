#include "coupling/case/case.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
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
[expected]
f0_Hz = { value = 120, tolerance = 5, source = "a measurement" }
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
  CHECK(config.mesh.parameters.at("half_gap") == 2.5e-4);
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
  CHECK(config.acoustics[0].analogy == "pressure_rate");
  CHECK(config.acoustics[0].step == config.time.step);
  CHECK(config.acoustics[1].step == 2e-6);
  CHECK(config.acoustics[0].boundaries[0].radius == 0.05);
  CHECK(config.microphones[0].position == std::array<double, 3>{0.2, 0, 0});
  CHECK(config.monitors[0].axis == 1);
  CHECK(config.output.directory == "runs/example");
  CHECK(config.expected.at("f0_Hz").tolerance == 5);
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
  CHECK(config.acoustics[0].analogy == "none");
  REQUIRE(config.acoustics[0].boundaries.size() == 1);
  CHECK(config.acoustics[0].boundaries[0].kind == acoustic::AcousticBoundaryKind::flux);
  CHECK(config.resolved.find("viscosity") == std::string::npos);
  CHECK_THAT(message_of(folder, text, {"acoustic.analogy=pressure_rate"}), Contains("needs a flow"));
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
             Contains("case.toml:11: region[fold].name") && Contains("\"folds\""));
  CHECK_THAT(message(2, regions, {"inlett", "sides", "open", "surface"}),
             Contains("flow.boundary[inlet].group") && Contains("did you mean \"inlett\""));
  CHECK_THAT(message(2, {"air", "fold", "room"}, groups), Contains("nothing about \"room\""));
  CHECK_THAT(message(2, regions, {}), Contains("no named groups"));
  CHECK_THAT(message(3, regions, groups), Contains("3 components"));
}
