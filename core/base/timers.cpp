#include "core/base/timers.hpp"

#include <algorithm>
#include <cstdint>

#include "core/base/mpi.hpp"

namespace vocalis::base {

namespace {

Timers::Phase& find_or_add(std::vector<Timers::Phase>& phases, std::string_view name) {
  const auto found =
      std::find_if(phases.begin(), phases.end(), [&](const Timers::Phase& phase) { return phase.name == name; });
  if (found != phases.end()) return *found;
  return phases.emplace_back(Timers::Phase{std::string(name), 0, 0, {}});
}

}  // namespace

Timers::Scope::Scope(Timers& timers, std::string_view name)
    : timers_(timers), name_(name), start_(std::chrono::steady_clock::now()), traffic_before_(traffic()) {}

Timers::Scope::~Scope() {
  Traffic sent = traffic();
  sent -= traffic_before_;
  timers_.add(name_, std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(), sent);
}

void Timers::add(std::string_view name, double seconds, const Traffic& traffic) {
  Phase& phase = find_or_add(phases_, name);
  phase.seconds += seconds;
  ++phase.calls;
  phase.traffic += traffic;
}

std::vector<Timers::Phase> largest_over_ranks(MPI_Comm comm, const std::vector<Timers::Phase>& phases) {
  std::vector<char> names;
  std::vector<double> seconds;
  std::vector<std::int64_t> counts;  // of each phase: calls, then its traffic
  for (const Timers::Phase& phase : phases) {
    names.insert(names.end(), phase.name.begin(), phase.name.end());
    names.push_back('\n');
    seconds.push_back(phase.seconds);
    const Traffic& sent = phase.traffic;
    counts.insert(counts.end(), {phase.calls, sent.messages, sent.bytes, sent.reductions, sent.reduction_bytes});
  }
  const std::vector<char> all_names = concatenate_all(comm, names);
  const std::vector<double> all_seconds = concatenate_all(comm, seconds);
  const std::vector<std::int64_t> all_counts = concatenate_all(comm, counts);

  std::vector<Timers::Phase> result;
  auto start = all_names.begin();
  for (std::size_t i = 0; i < all_seconds.size(); ++i) {
    const auto end = std::find(start, all_names.end(), '\n');
    Timers::Phase& phase = find_or_add(result, std::string(start, end));
    phase.seconds = std::max(phase.seconds, all_seconds[i]);
    const std::int64_t* count = all_counts.data() + 5 * i;
    phase.calls = std::max(phase.calls, static_cast<long>(count[0]));
    phase.traffic.keep_larger({count[1], count[2], count[3], count[4]});
    start = end + 1;
  }
  return result;
}

}  // namespace vocalis::base
