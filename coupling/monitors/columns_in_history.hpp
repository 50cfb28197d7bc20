#pragma once

#include <vector>

#include "core/io/series_reader.hpp"
#include "coupling/monitors/monitor_settings.hpp"

namespace vocalis::coupling {

/// The columns of a monitor that a history has, which knows the dimension by them; none if it has not all of them.
std::vector<MonitorColumn> columns_in(const io::Series& history, const MonitorSettings& monitor);

}  // namespace vocalis::coupling
