#include "coupling/monitors/columns_in_history.hpp"

#include <algorithm>

namespace vocalis::coupling {

std::vector<MonitorColumn> columns_in(const io::Series& history, const MonitorSettings& monitor) {
  std::vector<MonitorColumn> most;
  for (const int dimension : {3, 2}) {
    const std::vector<MonitorColumn> columns = columns_of(monitor, dimension);
    const auto is_there = [&](const MonitorColumn& column) { return history.find(column.name()) != nullptr; };
    if (columns.size() > most.size() && std::all_of(columns.begin(), columns.end(), is_there)) most = columns;
  }
  return most;
}

}  // namespace vocalis::coupling
