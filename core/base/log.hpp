#pragma once

#include <fmt/format.h>
#include <mpi.h>

#include <memory>
#include <string>
#include <utility>

namespace vocalis::base {

/// What a progress line says.
struct Progress {
  long step = 0;
  double time = 0;     ///< [s]
  double end = 0;      ///< [s]
  double dt = 0;       ///< [s]
  int iterations = 0;  ///< non-linear iterations of the step
};

/// Words for people: rank 0 writes to standard output and, once opened, to a file; the other ranks do nothing. Not
/// collective. Progress is one line that a terminal updates in place, and a plain line now and then anywhere else.
class Log {
 public:
  struct Settings {
    bool quiet = false;                    ///< nothing to standard output
    bool terminal = is_terminal();         ///< standard output can be updated in place
    double seconds_between_updates = 0.2;  ///< [s] on a terminal
    double seconds_between_lines = 10;     ///< [s] elsewhere, and in the file
  };

  explicit Log(MPI_Comm comm);
  Log(MPI_Comm comm, const Settings& settings);
  ~Log();
  Log(Log&&) noexcept;
  Log& operator=(Log&&) noexcept;

  /// All that follows goes to this file, too. `append` is for a run that goes on.
  /// Returns whether the file could be opened; true on ranks other than 0.
  bool open_file(const std::string& path, bool append = false);

  template <class... Arguments>
  void info(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    if (speaks()) line(fmt::format(text, std::forward<Arguments>(arguments)...));
  }

  /// Called every step; the log decides what of it is shown. Seconds left are reckoned from the steps since the first
  /// call, or since `time` went back.
  void progress(const Progress& now);
  /// Writes the last progress, if it was not shown, and ends the line that is updated in place.
  void end_progress();

  bool speaks() const { return inside_ != nullptr; }

 private:
  void line(const std::string& text);
  static bool is_terminal();

  struct Inside;
  std::unique_ptr<Inside> inside_;  ///< on rank 0 only
};

/// "step 120  t 0.0123 s of 0.2 s (6 %)  dt 1e-05 s  4 iterations  3 min 20 s left"; seconds_left < 0: not known yet.
std::string progress_line(const Progress& now, double seconds_left);

/// "42 s", "3 min 20 s", "2 h 05 min"
std::string duration_words(double seconds);

}  // namespace vocalis::base
