#include "coupling/case/case.hpp"
#include "tests/all_ranks.hpp"
#include "tests/coupling/case/case_folder.hpp"

using namespace vocalis;
using namespace vocalis::coupling;
using Catch::Matchers::Contains;
using test::Folder, test::message_of, test::example;

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
