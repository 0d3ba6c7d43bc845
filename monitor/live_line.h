// The one line that a person watches.
#pragma once

#include <string>

#include "monitor/flight_watch.h"

namespace tern {

/// "  6.4 s   48 %  5.93 m/s  nearest 0.72 m, wall 0.31 m  replan 4.1/12.3 ms (p50/p99)  in time 128/128", what is
/// wrong behind it; or what is waited for. Where that is wider than `columns`, replanning times and then the answers in
/// time are left out, so that what is wrong stays.
std::string live_line(const LiveView& view, std::size_t columns = std::string::npos);

/// The text's first `columns` columns, so that a terminal does not wrap it. UTF-8 is cut between characters, each taken
/// as one column.
std::string fit(const std::string& text, std::size_t columns);

}  // namespace tern
