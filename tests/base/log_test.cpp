#include "core/base/log.hpp"

#include <cstdio>
#include <fstream>
#include <sstream>

#include "core/base/mpi.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis::base;
using Catch::Matchers::Contains;

namespace {

std::string content(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("the first rank writes to the file, the others are silent") {
  const std::string path = "/tmp/vocalis_log_" + std::to_string(size(MPI_COMM_WORLD)) + ".txt";
  {
    Log log(MPI_COMM_WORLD, {.quiet = true, .terminal = false});
    CHECK(log.speaks() == (rank(MPI_COMM_WORLD) == 0));
    CHECK(log.open_file(path));
    log.info("dt is {} s", 0.5);
    log.info("rank {}", rank(MPI_COMM_WORLD));
    for (int step = 1; step <= 5; ++step) log.progress({step, 0.1 * step, 1.0, 0.1, 3});
  }
  if (rank(MPI_COMM_WORLD) != 0) return;
  const std::string text = content(path);
  CHECK_THAT(text, Contains("dt is 0.5 s") && Contains("rank 0") && !Contains("rank 1"));
  CHECK_THAT(text, Contains("step 1 ") && !Contains("step 3 ") && Contains("step 5 "));
  std::remove(path.c_str());
}

TEST_CASE("a log that is continued keeps what was there", "[serial]") {
  const std::string path = "/tmp/vocalis_log_append.txt";
  for (const bool append : {false, true}) {
    Log log(MPI_COMM_WORLD, {.quiet = true, .terminal = false});
    CHECK(log.open_file(path, append));
    log.info("append {}", append);
  }
  CHECK_THAT(content(path), Contains("append false") && Contains("append true"));
  std::remove(path.c_str());
  CHECK_FALSE(Log(MPI_COMM_WORLD, {.quiet = true, .terminal = false}).open_file("/proc/nowhere/log.txt"));
}

TEST_CASE("a progress line names step, time, dt, iterations and what is left", "[serial]") {
  CHECK(progress_line({120, 0.05, 0.2, 1e-5, 4}, 200) ==
        "step 120  t 0.05 s of 0.2 s (25 %)  dt 1e-05 s  4 iterations  3 min 20 s left");
  CHECK(duration_words(42) == "42 s");
  CHECK(duration_words(7500) == "2 h 05 min");
}
