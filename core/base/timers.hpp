#pragma once

#include <mpi.h>

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/traffic.hpp"

namespace vocalis::base {

/// Wall seconds of named phases and what they sent to other ranks, added up. `const auto scope =
/// timers.scope("flow.assemble");` times its own scope.
class Timers {
 public:
  struct Phase {
    std::string name;
    double seconds = 0;  ///< [s]
    long calls = 0;
    Traffic traffic;
  };

  class Scope {
   public:
    Scope(Timers& timers, std::string_view name);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Timers& timers_;
    std::string_view name_;
    std::chrono::steady_clock::time_point start_;
    Traffic traffic_before_;
  };

  /// `name` must outlive the scope; it is a literal.
  [[nodiscard]] Scope scope(std::string_view name) { return {*this, name}; }
  void add(std::string_view name, double seconds, const Traffic& traffic = {});

  /// The phases of this rank, in the order in which they first ended.
  const std::vector<Phase>& phases() const { return phases_; }

 private:
  std::vector<Phase> phases_;
};

/// The phases of all ranks, each with the largest seconds, calls and counts of any rank; ranks may have timed different
/// phases. In the order of the lowest rank that has them. Collective.
std::vector<Timers::Phase> largest_over_ranks(MPI_Comm comm, const std::vector<Timers::Phase>& phases);

}  // namespace vocalis::base
