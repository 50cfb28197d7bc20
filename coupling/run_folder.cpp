#include "coupling/run_folder.hpp"

#include <filesystem>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"

namespace vocalis::coupling {

namespace {

/// Whether a run writes files of this name.
bool is_of_a_run(const std::string& name) {
  for (const char* known : {"checkpoint.h5", "summary.json", "report.html", "spectra.csv", "harmonics.csv", "fields.h5",
                            "fields.xdmf", "periods.csv", "flow_record.h5"}) {
    if (name == known) return true;
  }
  if (name.starts_with("kymogram_") && name.ends_with(".csv")) return true;
  return name.starts_with("microphone") && (name.ends_with(".wav") || name.ends_with(".csv"));
}

}  // namespace

void prepare_run_folder(MPI_Comm comm, const std::string& folder) {
  std::vector<char> problem;
  if (base::rank(comm) == 0) {
    std::error_code code;
    std::filesystem::create_directories(folder, code);
    if (!std::filesystem::is_directory(folder)) {
      const std::string text = code ? code.message() : "a file of that name";
      problem.assign(text.begin(), text.end());
    } else {
      std::vector<std::filesystem::path> old;
      for (std::filesystem::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
        if (is_of_a_run(entry->path().filename().string())) old.push_back(entry->path());
      }
      for (const auto& path : old) std::filesystem::remove(path, code);
    }
  }
  base::broadcast(comm, problem);
  if (!problem.empty()) {
    throw base::UserError("the run folder must be a folder that can be made: " + folder,
                          std::string(problem.begin(), problem.end()), "choose another with --out DIR");
  }
}

}  // namespace vocalis::coupling
