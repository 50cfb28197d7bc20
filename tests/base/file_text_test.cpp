#include "core/base/file_text.hpp"

#include <cstdio>
#include <fstream>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis::base;

TEST_CASE("every rank gets the text of a file") {
  const std::string path = "/tmp/vocalis_text_" + std::to_string(size(MPI_COMM_WORLD)) + ".toml";
  if (rank(MPI_COMM_WORLD) == 0) std::ofstream(path) << "a = 1\n";
  const std::string text = read_text(MPI_COMM_WORLD, path, "case file");
  REQUIRE_ON_ALL_RANKS(text == "a = 1\n");
  if (rank(MPI_COMM_WORLD) == 0) std::remove(path.c_str());
}

TEST_CASE("a file that cannot be read is an error on every rank") {
  CHECK_THROWS_AS(read_text(MPI_COMM_WORLD, "/nowhere/case.toml", "case file"), UserError);
  CHECK_THROWS_AS(read_text(MPI_COMM_WORLD, "/tmp", "case file"), UserError);
}
