#include "core/base/index_map.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "core/base/mpi.hpp"

namespace vocalis::base {

namespace {

/// Answers, for keys sent to their meeting rank, the lowest value sent for the same key.
std::vector<std::vector<std::int64_t>> lowest_per_key(const std::vector<std::vector<std::int64_t>>& keys,
                                                      const std::vector<std::vector<std::int64_t>>& values) {
  std::unordered_map<std::int64_t, std::int64_t> lowest;
  for (std::size_t r = 0; r < keys.size(); ++r) {
    for (std::size_t i = 0; i < keys[r].size(); ++i) {
      const auto [entry, is_new] = lowest.try_emplace(keys[r][i], values[r][i]);
      if (!is_new) entry->second = std::min(entry->second, values[r][i]);
    }
  }
  std::vector<std::vector<std::int64_t>> answers(keys.size());
  for (std::size_t r = 0; r < keys.size(); ++r) {
    answers[r].reserve(keys[r].size());
    for (const std::int64_t key : keys[r]) answers[r].push_back(lowest.at(key));
  }
  return answers;
}

/// Sends (key, value) of each local key to the key's meeting rank; returns the lowest value over all ranks per key.
std::vector<std::int64_t> lowest_over_ranks(MPI_Comm comm, const std::vector<std::int64_t>& keys,
                                            const std::vector<std::int64_t>& values) {
  const int ranks = size(comm);
  std::vector<std::vector<std::int64_t>> key_lists(ranks), value_lists(ranks);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    key_lists[keys[i] % ranks].push_back(keys[i]);
    value_lists[keys[i] % ranks].push_back(values[i]);
  }
  const auto answers = exchange(comm, lowest_per_key(exchange(comm, key_lists), exchange(comm, value_lists)));
  std::vector<std::size_t> next(ranks, 0);
  std::vector<std::int64_t> result(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const std::size_t home = static_cast<std::size_t>(keys[i] % ranks);
    result[i] = answers[home][next[home]++];
  }
  return result;
}

}  // namespace

IndexMap contiguous_index_map(MPI_Comm comm, std::int32_t num_owned) {
  IndexMap map;
  map.comm = comm;
  map.num_owned = num_owned;
  const std::int64_t mine = num_owned;
  MPI_Exscan(&mine, &map.offset, 1, MPI_INT64_T, MPI_SUM, comm);
  if (rank(comm) == 0) map.offset = 0;
  map.num_global = sum(comm, mine);
  return map;
}

SharedNumbering number_shared(MPI_Comm comm, const std::vector<std::int64_t>& keys) {
  const int here = rank(comm);
  const std::vector<std::int64_t> owner = lowest_over_ranks(comm, keys, std::vector<std::int64_t>(keys.size(), here));

  SharedNumbering result;
  result.key_to_local.resize(keys.size());
  std::int32_t num_owned = 0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (owner[i] == here) result.key_to_local[i] = num_owned++;
  }
  result.map = contiguous_index_map(comm, num_owned);

  constexpr std::int64_t unknown = std::numeric_limits<std::int64_t>::max();
  std::vector<std::int64_t> global(keys.size(), unknown);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (owner[i] == here) global[i] = result.map.offset + result.key_to_local[i];
  }
  global = lowest_over_ranks(comm, keys, global);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (owner[i] == here) continue;
    result.key_to_local[i] = result.map.num_local();
    result.map.ghost_global.push_back(global[i]);
    result.map.ghost_owner.push_back(static_cast<int>(owner[i]));
  }
  return result;
}

}  // namespace vocalis::base
