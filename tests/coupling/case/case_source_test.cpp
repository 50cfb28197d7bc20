#include <cmath>

#include "core/io/wav.hpp"
#include "coupling/case/case.hpp"
#include "tests/all_ranks.hpp"
#include "tests/coupling/case/case_folder.hpp"

using namespace vocalis;
using namespace vocalis::coupling;
using Catch::Matchers::Contains;
using test::Folder, test::message_of;

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
