#include "core/base/case_table.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "core/base/case_override.hpp"
#include "core/base/error.hpp"

using namespace vocalis::base;
using Catch::Matchers::Contains;

namespace {

const char* const example = R"(
[time]
end = 1          # line 3
dt = 1e-5
scheme = "bdf2"
long = true

[[region]]
name = "air"
[[region]]
name = "fold"
density = 1040.0

[[microphone]]
position = [0.0, 1, 2]
)";

template <class Call>
std::string message_of(Call call) {
  try {
    call();
  } catch (const UserError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("a table answers with the values of the file") {
  TomlNode tree = parse_toml(example, "case.toml");
  Table root(tree);
  Table time = root.table("time");
  CHECK(time.number("end", positive, "s") == 1);
  CHECK(time.number("dt", positive, "s") == 1e-5);
  CHECK(time.text("scheme", {"theta", "bdf2"}) == "bdf2");
  CHECK(time.boolean_or("long", false));
  CHECK(time.number_or("theta", 0.5, between(0.5, 1)) == 0.5);
  std::vector<Table> regions = root.tables("region");
  REQUIRE(regions.size() == 2);
  CHECK(regions[1].path("density") == "region[fold].density");
  CHECK(regions[1].place("density") == "case.toml:12: region[fold].density");
  CHECK(root.tables("microphone").front().numbers("position", 2, 3, "m") == std::vector<double>{0, 1, 2});
  TomlNode names = parse_toml("groups = [\"wall\", \"flag\"]\nnone = []", "case.toml");
  CHECK(Table(names).texts("groups") == std::vector<std::string>{"wall", "flag"});
  CHECK_THAT(message_of([&] { Table(names).texts("none"); }), Contains("must not be empty"));
  CHECK(root.tables("acoustic").empty());
  CHECK_FALSE(root.table_if("flow").has_value());
}

TEST_CASE("a wrong value is told with file, line, key, rule, value and remedy") {
  TomlNode tree = parse_toml("a = -1.5\nb = \"10 ms\"\nc = nan\nd = 1.0\ne = inf\nf = [1, 2]\ng = \"\"", "case.toml");
  Table table(tree);
  const std::string range = message_of([&] { table.number("a", positive, "s"); });
  CHECK_THAT(range, Contains("case.toml:1: a must be positive [s]") && Contains("-1.5") && Contains("remedy"));
  const std::string type = message_of([&] { table.number("b", positive, "s"); });
  CHECK_THAT(type, Contains("case.toml:2: b must be a number [s]") && Contains("a text: \"10 ms\"") &&
                       Contains("without quotes and unit"));
  CHECK_THAT(message_of([&] { table.number("c", any_number); }), Contains("finite") && Contains("nan"));
  CHECK_THAT(message_of([&] { table.number("e", any_number); }), Contains("finite") && Contains("inf"));
  CHECK_THAT(message_of([&] { table.integer("d", any_number); }),
             Contains("a whole number") && Contains("a number: 1.0"));
  CHECK_THAT(message_of([&] { table.numbers("f", 3, 3, "m"); }), Contains("an array of 3 numbers [m]"));
  CHECK_THAT(message_of([&] { table.text("g"); }), Contains("must not be empty"));
  CHECK_THAT(message_of([&] { table.texts("f"); }), Contains("f must be an array of texts") && Contains("number: 1"));
  CHECK_THAT(message_of([&] { table.texts("b"); }), Contains("square brackets"));
  CHECK_THAT(message_of([&] { table.table("f"); }), Contains("must be a table") && Contains("an array"));
  CHECK_THAT(message_of([&] { table.tables("a"); }), Contains("an array of tables") && Contains("[[a]]"));
  CHECK_THAT(message_of([&] { table.number("missing", any_number); }),
             Contains("is needed") && Contains("add the key"));
}

TEST_CASE("a range says what it accepts") {
  CHECK(positive.words() == "positive");
  CHECK(not_negative.words() == "zero or positive");
  CHECK(between(0.5, 1).words() == "from 0.5 to 1");
  CHECK(inside(-1, 0.5).words() == "more than -1 and less than 0.5");
  CHECK(inside(-1, 0.5).contains(0.49));
  CHECK_FALSE(inside(-1, 0.5).contains(0.5));
  CHECK_FALSE(positive.contains(0));
  CHECK(not_negative.contains(0));
}

TEST_CASE("a key that nobody asked for is an error that proposes the nearest name") {
  TomlNode tree = parse_toml("[flow]\ndensity = 1.2\nviscosty = 1e-5\n", "case.toml");
  Table root(tree);
  Table flow = root.table("flow");
  flow.number("density", positive);
  flow.number_or("viscosity", 1e-5, positive);
  const std::string message = message_of([&] { root.reject_unknown_keys(); });
  CHECK_THAT(message, Contains("case.toml:3: flow.viscosty") && Contains("did you mean \"viscosity\"?"));
}

TEST_CASE("a needed key that is misspelt is recognised") {
  TomlNode tree = parse_toml("densty = 1.2\n", "case.toml");
  Table table(tree);
  CHECK_THAT(message_of([&] { table.number("density", positive); }),
             Contains("density is needed") && Contains("where \"densty\" stands"));
}

TEST_CASE("an unknown key is found in elements of arrays of tables and in inline tables") {
  TomlNode tree =
      parse_toml("[[region]]\nname = \"air\"\nkid = 1\n[expected]\nf0 = { value = 1, tol = 2 }\n", "c.toml");
  Table root(tree);
  for (Table& region : root.tables("region")) region.text("name");
  CHECK_THAT(message_of([&] { root.reject_unknown_keys(); }), Contains("c.toml:3: region[air].kid"));
  tree.children.pop_front();
  root.table("expected").table("f0").number("value", any_number);
  CHECK_THAT(message_of([&] { root.reject_unknown_keys(); }), Contains("expected.f0.tol"));
}

TEST_CASE("text that is not TOML is refused with file and line") {
  CHECK_THAT(message_of([] { parse_toml("a = 1\nb = = 2\n", "case.toml"); }),
             Contains("case.toml:2") && Contains("TOML"));
  CHECK_THAT(message_of([] { parse_toml("a = 1\na = 2\n", "case.toml"); }), Contains("case.toml:2"));
}

TEST_CASE("the resolved tree holds defaults and units, keeps the order, and can be read again") {
  TomlNode tree = parse_toml(example, "case.toml");
  Table root(tree);
  Table time = root.table("time");
  time.number("dt", positive, "s");
  time.number_or("smallest", 1.0 / 3, positive, "s");
  root.table_or_empty("output").text_or("directory", "a \"b\"\\");
  const std::string written = write_toml(tree);
  CHECK_THAT(written, Contains("dt = 1e-05  # [s]\n") && Contains("smallest = 0.3333333333333333  # [s] default\n"));
  CHECK(written.find("end = 1") < written.find("dt = "));
  TomlNode again = parse_toml(written, "resolved.toml");
  CHECK(Table(again).table("time").number("smallest", positive) == 1.0 / 3);
  CHECK(Table(again).table("output").text("directory") == "a \"b\"\\");
  CHECK(Table(again).tables("region").size() == 2);
}

TEST_CASE("an override sets values, texts without quotes, and new keys") {
  TomlNode tree = parse_toml(example, "case.toml");
  apply_override(tree, "time.dt=2e-6");
  apply_override(tree, "time.scheme=theta");
  apply_override(tree, "mesh.parameters.size=3");
  apply_override(tree, "microphone.position=[1, 2]");
  Table root(tree);
  CHECK(root.table("time").number("dt", positive) == 2e-6);
  CHECK(root.table("time").text("scheme") == "theta");
  CHECK(root.table("mesh").table("parameters").integer("size", positive) == 3);
  CHECK(root.tables("microphone")[0].numbers("position", 2, 3).size() == 2);
  apply_override(tree, "time.dt=-1");
  CHECK_THAT(message_of([&] { root.table("time").number("dt", positive); }), Contains("--set time.dt=-1: time.dt"));
}

TEST_CASE("an override means one table of an array by name or index, or all of them") {
  TomlNode tree = parse_toml(example, "case.toml");
  Table root(tree);
  apply_override(tree, "region.density=1");
  apply_override(tree, "region.fold.density=2");
  std::vector<Table> regions = root.tables("region");
  CHECK(regions[0].number("density", positive) == 1);
  CHECK(regions[1].number("density", positive) == 2);
  apply_override(tree, "region.0.density=3");
  CHECK(regions[0].number("density", positive) == 3);
}

TEST_CASE("an override that makes no sense is refused") {
  TomlNode tree = parse_toml(example, "case.toml");
  for (const char* bad : {"time.dt", "=1", "time.dt=", "time..dt=1", ".dt=1", "region.7.density=1",
                          "region.fould.density=1", "region.fold=1", "time.dt.x=1"}) {
    INFO(bad);
    CHECK_THROWS_AS(apply_override(tree, bad), UserError);
  }
  CHECK_THAT(message_of([&] { apply_override(tree, "region.fould.density=1"); }), Contains("did you mean \"fold\""));
}

TEST_CASE("the nearest name forgives a swap and two slips, not more") {
  CHECK(nearest_name("viscosty", {"density", "viscosity"}) == "viscosity");
  CHECK(nearest_name("edn", {"end", "dt"}) == "end");
  CHECK(nearest_name("banana", {"end", "dt"}).empty());
  CHECK(nearest_name("x", {"dt"}).empty());
}
