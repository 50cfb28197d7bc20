#include "core/io/checkpoint.hpp"

#include <cmath>
#include <fstream>
#include <limits>

#include "tests/all_ranks.hpp"
#include "tests/io/rank_0.hpp"
#include "tests/io/temporary_folder.hpp"

using namespace vocalis;
using namespace vocalis::io;

namespace {

/// Rank r has r numbers: rank 0 has none.
std::vector<double> numbers_of(int rank) {
  std::vector<double> values(rank);
  for (int i = 0; i < rank; ++i) values[i] = std::sqrt(rank + 0.1 * i);
  return values;
}

void write_checkpoint(const std::string& path, double scalar) {
  const int rank = base::rank(MPI_COMM_WORLD);
  CheckpointWriter writer(MPI_COMM_WORLD, path);
  writer.add("flow.velocity", numbers_of(rank));
  writer.add("time", std::vector<double>{scalar});
  writer.add("cells", std::vector<std::int64_t>{rank, std::int64_t{1} << 62});
  writer.add("nothing", std::span<const double>());
  writer.add_text("case", "[case]\nname = \"é\"\n");
  writer.add_text("empty", "");
  writer.commit();
}

std::string message_of(const std::string& path) {
  return user_error_of([&] { CheckpointReader(MPI_COMM_WORLD, path); });
}

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

}  // namespace

TEST_CASE("a checkpoint gives each rank its own numbers back") {
  const TemporaryFolder folder;
  const std::string path = folder.file("checkpoint.h5");
  write_checkpoint(path, 1.0 / 3);
  const int rank = base::rank(MPI_COMM_WORLD);
  const CheckpointReader reader(MPI_COMM_WORLD, path);
  CHECK(reader.doubles("flow.velocity") == numbers_of(rank));
  CHECK(reader.doubles("time") == std::vector<double>{1.0 / 3});
  CHECK(reader.doubles("nothing").empty());
  CHECK(reader.integers("cells") == std::vector<std::int64_t>{rank, std::int64_t{1} << 62});
  CHECK(reader.text("case") == "[case]\nname = \"é\"\n");
  CHECK(reader.text("empty").empty());
}

TEST_CASE("a checkpoint keeps not-a-number, infinity and the sign of zero") {
  const TemporaryFolder folder;
  const std::string path = folder.file("checkpoint.h5");
  CheckpointWriter writer(MPI_COMM_WORLD, path);
  const double infinity = std::numeric_limits<double>::infinity();
  writer.add("odd", std::vector<double>{std::nan(""), infinity, -0.0});
  writer.commit();
  const auto odd = CheckpointReader(MPI_COMM_WORLD, path).doubles("odd");
  REQUIRE_ON_ALL_RANKS(odd.size() == 3);
  CHECK(std::isnan(odd[0]));
  CHECK(odd[1] == infinity);
  CHECK(std::signbit(odd[2]));
}

TEST_CASE("a new checkpoint takes the place of the old one and leaves nothing else") {
  const TemporaryFolder folder;
  const std::string path = folder.file("checkpoint.h5");
  write_checkpoint(path, 1);
  write_checkpoint(path, 2);
  CHECK(CheckpointReader(MPI_COMM_WORLD, path).doubles("time") == std::vector<double>{2});
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++files;
  CHECK(files == 1);
}

TEST_CASE("a name that a checkpoint lacks is an error on every rank, and the reader still reads") {
  const TemporaryFolder folder;
  const std::string path = folder.file("checkpoint.h5");
  write_checkpoint(path, 1);
  const CheckpointReader reader(MPI_COMM_WORLD, path);
  CHECK(has(user_error_of([&] { reader.doubles("flow.presure"); }), "flow.presure"));
  CHECK(has(user_error_of([&] { reader.integers("time"); }), "another kind"));
  CHECK_THROWS_AS(reader.text("cells"), base::UserError);
  CHECK_THROWS_AS(reader.doubles("a/b/c"), base::UserError);
  CHECK(reader.doubles("time") == std::vector<double>{1});
}

TEST_CASE("a checkpoint that was cut off anywhere is an error on every rank") {
  const TemporaryFolder folder;
  const std::string path = folder.file("checkpoint.h5");
  write_checkpoint(path, 1);
  const auto size = std::filesystem::file_size(path);
  for (const std::uintmax_t bytes :
       {std::uintmax_t{0}, std::uintmax_t{5}, std::uintmax_t{18}, std::uintmax_t{60}, std::uintmax_t{511},
        std::uintmax_t{512}, std::uintmax_t{600}, size / 2, size - 1}) {
    on_rank_0([&] { std::filesystem::resize_file(path, bytes); });
    INFO("cut off after " << bytes << " bytes");
    CHECK(has(message_of(path), bytes < 18   ? "must be a checkpoint of Vocalis"
                                : bytes < 20 ? "version"
                                             : "must be whole"));
    MPI_Barrier(MPI_COMM_WORLD);
    write_checkpoint(path, 1);
  }
}

TEST_CASE("a flipped bit anywhere in a checkpoint is an error on every rank") {
  const TemporaryFolder folder;
  const std::string path = folder.file("checkpoint.h5");
  write_checkpoint(path, 1);
  const auto size = static_cast<long>(std::filesystem::file_size(path));
  const auto flip = [&](long place) {
    on_rank_0([&] {
      std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
      file.seekg(place);
      const char byte = static_cast<char>(file.get() ^ 16);
      file.seekp(place);
      file.put(byte);
    });
  };
  for (long place = 0; place < size; place += size / 101) {
    flip(place);
    INFO("byte " << place);
    CHECK(!message_of(path).empty());
    flip(place);
  }
  CHECK(message_of(path).empty());
}

TEST_CASE("a checkpoint of other ranks, of another version, or none is an error that says what to do") {
  const TemporaryFolder folder;
  const std::string path = folder.file("checkpoint.h5");
  CHECK(has(message_of(path), "must be readable"));
  CHECK(has(message_of(folder.path()), "checkpoint"));
  const int ranks = base::size(MPI_COMM_WORLD);
  if (ranks > 1) {
    MPI_Comm alone = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, base::rank(MPI_COMM_WORLD) == 0 ? 0 : MPI_UNDEFINED, 0, &alone);
    on_rank_0([&] { CheckpointWriter(alone, path).commit(); });
    if (alone != MPI_COMM_NULL) MPI_Comm_free(&alone);
    CHECK(has(message_of(path), "resume with --ranks 1"));
  }
  on_rank_0([&] { std::ofstream(path) << "vocalis checkpoint 99\nbytes 0\n"; });
  CHECK(has(message_of(path), "99"));
}

TEST_CASE("a checkpoint that cannot be written is an error on every rank") {
  const TemporaryFolder folder;
  CheckpointWriter writer(MPI_COMM_WORLD, folder.file("nowhere/checkpoint.h5"));
  writer.add("time", std::vector<double>{1});
  CHECK_THROWS_AS(writer.commit(), base::UserError);
}
