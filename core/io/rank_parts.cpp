#include "core/io/rank_parts.hpp"

#include <limits>
#include <stdexcept>

namespace vocalis::io {

Parts make_parts(std::span<const std::int64_t> counts) {
  Parts parts;
  std::int64_t total = 0;
  for (const std::int64_t count : counts) {
    parts.starts.push_back(static_cast<int>(total));
    parts.counts.push_back(static_cast<int>(count));
    total += count;
    if (total > std::numeric_limits<int>::max()) throw std::length_error("an array for a file has over 2^31 numbers");
  }
  parts.total = static_cast<int>(total);
  return parts;
}

}  // namespace vocalis::io
