#include <cmath>
#include <fstream>
#include <limits>
#include <vector>

#include "core/io/series_reader.hpp"
#include "core/io/series_writer.hpp"
#include "tests/all_ranks.hpp"
#include "tests/io/rank_0.hpp"
#include "tests/io/temporary_folder.hpp"

using namespace vocalis;
using namespace vocalis::io;

namespace {

const std::vector<std::string> columns = {"step", "time_s", "pressure_Pa.mouth"};

/// Time of a step: a number that no short decimal stands for.
double time_of(int step) { return 0.1 * step; }

void write_rows(SeriesWriter& writer, int first, int last) {
  for (int step = first; step <= last; ++step) {
    writer.write(std::vector<double>{double(step), time_of(step), std::sin(step) * 1e-3});
  }
  writer.flush();
}

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

TEST_CASE("a series gives the same doubles back, with its header") {
  const TemporaryFolder folder;
  const std::string path = folder.file("history.csv");
  SeriesWriter writer(MPI_COMM_WORLD, path, {{"unit of time", "s"}, {"density", "1.2 kg/m^3"}}, columns);
  const double tiny = std::numeric_limits<double>::denorm_min();
  writer.write(std::vector<double>{1, 0.1, -1.0 / 3});
  writer.write(std::vector<double>{2, 0.1 + 0.2, tiny});
  writer.write(std::vector<double>{3, 1e300, std::nan("")});
  writer.flush();
  const Series series = read_series(path);
  CHECK(series.header.at("unit of time") == "s");
  CHECK(series.header.at("density") == "1.2 kg/m^3");
  REQUIRE_ON_ALL_RANKS(series.columns == columns);
  CHECK(series.values[1] == std::vector<double>{0.1, 0.1 + 0.2, 1e300});
  CHECK(series.values[2][0] == -1.0 / 3);
  CHECK(series.values[2][1] == tiny);
  CHECK(std::isnan(series.values[2][2]));
}

TEST_CASE("a series that was resumed has the bytes of one that was not") {
  const TemporaryFolder folder;
  const std::string whole = folder.file("whole.csv"), cut = folder.file("cut.csv");
  const SeriesWriter::Header header = {{"case", "test"}};
  {
    SeriesWriter writer(MPI_COMM_WORLD, whole, header, columns);
    write_rows(writer, 1, 9);
  }
  {
    SeriesWriter writer(MPI_COMM_WORLD, cut, header, columns);
    write_rows(writer, 1, 7);
  }
  const int last = GENERATE(0, 3, 7);
  {
    auto writer = SeriesWriter::resume(MPI_COMM_WORLD, cut, columns, 1, time_of(last));
    write_rows(writer, last + 1, 9);
  }
  CHECK(text_of(cut) == text_of(whole));
}

TEST_CASE("a series that was cut off anywhere can be resumed") {
  const TemporaryFolder folder;
  const std::string path = folder.file("history.csv");
  {
    SeriesWriter writer(MPI_COMM_WORLD, path, {}, columns);
    write_rows(writer, 1, 5);
  }
  const std::string whole = text_of(path);
  const int missing = GENERATE(1, 2, 25);
  on_rank_0([&] { std::filesystem::resize_file(path, whole.size() - missing); });
  {
    auto writer = SeriesWriter::resume(MPI_COMM_WORLD, path, columns, 0, 5);
    writer.flush();
  }
  const Series series = read_series(path);
  CHECK(series.values[0] == std::vector<double>{1, 2, 3, 4});
}

TEST_CASE("a series that cannot be written or resumed is an error on every rank") {
  const TemporaryFolder folder;
  const std::string nowhere = folder.file("nowhere/history.csv"), path = folder.file("history.csv");
  CHECK_THROWS_AS(SeriesWriter(MPI_COMM_WORLD, nowhere, {}, columns), base::UserError);
  CHECK_THROWS_AS(SeriesWriter::resume(MPI_COMM_WORLD, nowhere, columns, 0, 1), base::UserError);
  CHECK_THROWS_AS(SeriesWriter(MPI_COMM_WORLD, "/dev/full", {}, columns), base::UserError);
  on_rank_0([&] { std::ofstream(path) << "# unit: s\n"; });
  CHECK_THROWS_AS(SeriesWriter::resume(MPI_COMM_WORLD, path, columns, 0, 1), base::UserError);
  on_rank_0([&] { std::ofstream(path) << "step,time_s\n1,2\n"; });
  CHECK(user_error_of([&] { SeriesWriter::resume(MPI_COMM_WORLD, path, columns, 0, 1); }).find("step,time_s") !=
        std::string::npos);
}
