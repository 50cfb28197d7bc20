#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "coupling/case/case.hpp"

namespace vocalis::coupling::test {

/// A case of everything; its geometry is empty.
inline const char* const example = R"([case]
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

/// What read_case says to a case file of this text, on every rank.
inline std::string message_of(const Folder& folder, const std::string& text,
                              const std::vector<std::string>& overrides) {
  try {
    read_case(MPI_COMM_WORLD, folder.write(text), overrides);
  } catch (const base::UserError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace vocalis::coupling::test
