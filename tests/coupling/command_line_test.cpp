#include "coupling/command_line.hpp"

#include <catch2/catch.hpp>

#include "core/base/error.hpp"

using namespace vocalis;
using namespace vocalis::coupling;

TEST_CASE("run takes a case, an output folder and changes of values", "[serial]") {
  const Command command =
      parse_command({"run", "--set", "a.b=1", "my case.toml", "--set=c=-2", "--out", "my \"runs\"/one"});
  CHECK(command.kind == Command::Kind::run);
  CHECK(command.target == "my case.toml");
  CHECK(command.overrides == std::vector<std::string>{"a.b=1", "c=-2", "output.directory=\"my \\\"runs\\\"/one\""});
}

TEST_CASE("check, resume and spectrum take one name", "[serial]") {
  CHECK(parse_command({"check", "case.toml"}).kind == Command::Kind::check);
  CHECK(parse_command({"resume", "runs/a"}).kind == Command::Kind::resume);
  CHECK(parse_command({"spectrum", "runs/a"}).target == "runs/a");
}

TEST_CASE("a command that cannot be understood is the user's mistake", "[serial]") {
  const std::vector<std::vector<std::string>> mistakes = {{},
                                                          {"fly"},
                                                          {"run"},
                                                          {"run", "a", "b"},
                                                          {"run", "a", "--set"},
                                                          {"run", "a", "--speed", "3"},
                                                          {"resume", "a", "--set", "b=1"}};
  for (const auto& mistake : mistakes) CHECK_THROWS_AS(parse_command(mistake), base::UserError);
  CHECK_THROWS_WITH(parse_command({"chek", "a"}), Catch::Contains("did you mean \"check\""));
  CHECK_THROWS_WITH(parse_command({"run", "a", "--steps", "ten"}), Catch::Contains("at least 1 is needed, not ten"));
  CHECK(parse_command({"run", "a", "--steps", "10"}).steps == 10);
}

TEST_CASE("help is a command", "[serial]") {
  CHECK(parse_command({"--help"}).kind == Command::Kind::help);
  CHECK_THAT(parse_command({"run", "--help"}).text, Catch::Contains("--set"));
}

TEST_CASE("what follows -- is for PETSc", "[serial]") {
  const char* words[] = {"vocalis", "run", "case.toml", "--", "-log_view", "-ksp_type", "cg"};
  const Arguments arguments(7, const_cast<char**>(words));
  CHECK(arguments.ours == std::vector<std::string>{"run", "case.toml"});
  REQUIRE(arguments.petsc_count == 4);
  CHECK(std::string(arguments.petsc_values[0]) == "vocalis");
  CHECK(std::string(arguments.petsc_values[3]) == "cg");
  CHECK(arguments.petsc_values[4] == nullptr);
}
