#include "core/io/signal_reader.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"

using namespace vocalis;
using Catch::Contains;

namespace {

const std::string path = (std::filesystem::temp_directory_path() / "vocalis_signal.csv").string();

io::Signal read(const std::string& text, const std::string& column = "") {
  std::ofstream(path) << text;
  return io::read_signal(path, column);
}

std::string message_of(const std::string& text, const std::string& column = "") {
  try {
    read(text, column);
  } catch (const base::UserError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("a signal is read with and without names, whatever keeps its columns apart", "[serial]") {
  for (const char* text : {"time_s,flow\n0,1\n0.5,2.5\n", "0 1\n 0.5\t2.5", "# a note\n\n0;1\r\n0.5;2.5\r\n"}) {
    const io::Signal signal = read(text);
    CHECK(signal.times == std::vector<double>{0, 0.5});
    CHECK(signal.values == std::vector<double>{1, 2.5});
  }
  CHECK(read("t,a,b\n0,1,2\n1,3,4\n", "b").values == std::vector<double>{2, 4});
  std::filesystem::remove(path);
}

TEST_CASE("rows that are no samples are refused with file and line", "[serial]") {
  CHECK_THAT(message_of("t,a\n0,1\n1,x\n"), Contains("vocalis_signal.csv:3") && Contains("1,x"));
  CHECK_THAT(message_of("0,1\n1\n"), Contains(":2"));
  CHECK_THAT(message_of("0,1\n1,2,3\n"), Contains(":2"));
  CHECK_THAT(message_of("0\n1\n"), Contains(":1"));
  CHECK_THAT(message_of("t,flow\n0,1\n", "flov"), Contains("did you mean \"flow\""));
  CHECK_THAT(message_of("0,1\n", "flow"), Contains("no names"));
  std::filesystem::remove(path);
  CHECK_THROWS_WITH(io::read_signal(path), Contains("readable"));
}
