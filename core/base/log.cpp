#include "core/base/log.hpp"

#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "core/base/mpi.hpp"

namespace vocalis::base {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

}  // namespace

struct Log::Inside {
  Settings settings;
  std::shared_ptr<spdlog::logger> console;  // spdlog holds its sinks by shared pointers
  std::shared_ptr<spdlog::logger> file;

  Progress first, last;
  Clock::time_point first_at, console_at, file_at;
  bool running = false;         ///< between the first progress and end_progress
  bool console_behind = false;  ///< the last progress was not shown
  bool file_behind = false;
  bool line_open = false;  ///< the cursor stands at the end of a line that will be overwritten

  void clear_line() {
    if (!line_open) return;
    std::fputs("\r\033[K", stdout);
    line_open = false;
  }

  std::string words() const {
    const double done = last.time - first.time;
    const double left = done > 0 ? seconds_since(first_at) / done * (last.end - last.time) : -1;
    return progress_line(last, left);
  }

  void show_on_console() {
    if (settings.terminal && !settings.quiet) {
      std::fputs(("\r\033[K" + words()).c_str(), stdout);
      std::fflush(stdout);
      line_open = true;
    } else {
      console->info(words());
    }
    console_at = Clock::now();
    console_behind = false;
  }

  void write_to_file() {
    if (file) file->info(words());
    file_at = Clock::now();
    file_behind = false;
  }
};

Log::Log(MPI_Comm comm) : Log(comm, Settings()) {}

Log::Log(MPI_Comm comm, const Settings& settings) {
  if (rank(comm) != 0) return;
  inside_ = std::make_unique<Inside>();
  inside_->settings = settings;
  inside_->console = std::make_shared<spdlog::logger>("console");
  if (!settings.quiet) inside_->console->sinks().push_back(std::make_shared<spdlog::sinks::stdout_sink_st>());
  inside_->console->set_pattern("%v");
  inside_->console->flush_on(spdlog::level::info);
}

Log::~Log() {
  if (inside_) end_progress();
}
Log::Log(Log&&) noexcept = default;
Log& Log::operator=(Log&&) noexcept = default;

bool Log::open_file(const std::string& path, bool append) {
  if (!inside_) return true;
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_st>(path, !append);
    inside_->file = std::make_shared<spdlog::logger>("file", std::move(sink));
  } catch (const spdlog::spdlog_ex&) {
    return false;
  }
  inside_->file->set_pattern("%Y-%m-%d %H:%M:%S  %v");
  inside_->file->flush_on(spdlog::level::info);
  return true;
}

void Log::line(const std::string& text) {
  inside_->clear_line();
  inside_->console->info(text);
  if (inside_->file) inside_->file->info(text);
}

void Log::progress(const Progress& now) {
  if (!inside_) return;
  Inside& in = *inside_;
  if (!in.running || now.time < in.first.time) {
    in.first = now;
    in.first_at = Clock::now();
    // The first step says that it runs; the next line comes when there is something to tell.
    in.console_at = in.file_at = in.first_at - std::chrono::hours(1);
    in.running = true;
  }
  in.last = now;
  in.console_behind = in.file_behind = true;
  const double pause = in.settings.terminal ? in.settings.seconds_between_updates : in.settings.seconds_between_lines;
  if (seconds_since(in.console_at) >= pause) in.show_on_console();
  if (seconds_since(in.file_at) >= in.settings.seconds_between_lines) in.write_to_file();
}

void Log::end_progress() {
  if (!inside_ || !inside_->running) return;
  Inside& in = *inside_;
  if (in.console_behind) in.show_on_console();
  if (in.file_behind) in.write_to_file();
  if (in.line_open) {
    std::fputs("\n", stdout);
    std::fflush(stdout);
  }
  in.line_open = in.running = false;
}

/// mpirun gives its ranks a pseudo-terminal even when it writes to a file itself, so under it only the start script
/// knows, and says so in VOCALIS_TERMINAL.
bool Log::is_terminal() {
  if (const char* told = std::getenv("VOCALIS_TERMINAL")) return std::string_view(told) == "1";
  return std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr && isatty(STDOUT_FILENO) == 1;
}

std::string progress_line(const Progress& now, double seconds_left) {
  const double share = now.end > 0 ? 100 * now.time / now.end : 0;
  return fmt::format("step {}  t {:.6g} s of {:.6g} s ({:.0f} %)  dt {:.3g} s  {} iterations  {}", now.step, now.time,
                     now.end, share, now.dt, now.iterations,
                     seconds_left < 0 ? "" : duration_words(seconds_left) + " left");
}

std::string duration_words(double seconds) {
  const long all = std::lround(seconds);
  if (all < 60) return fmt::format("{} s", all);
  if (all < 3600) return fmt::format("{} min {:02} s", all / 60, all % 60);
  return fmt::format("{} h {:02} min", all / 3600, all % 3600 / 60);
}

}  // namespace vocalis::base
