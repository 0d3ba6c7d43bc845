// The live line of a flight.
#pragma once

#include <string>

#include "monitor/flight_watch.h"

namespace tern {

/// Formats a view as
///
///     6.4 s   48 %  5.93 m/s  nearest 0.72 m, wall 0.31 m  replan 4.1/12.3 ms (p50/p99)  in time 128/128
///
/// followed by problems; before the first request, the processes that are waited for. If that is wider than `columns`,
/// the replanning times and then the answers in time are left out, so that the problems stay visible.
std::string live_line(const LiveView& view, std::size_t columns = std::string::npos);

/// The first `columns` columns of the text, so that a terminal does not wrap it. UTF-8 is cut between characters; each
/// counts as one column.
std::string fit(const std::string& text, std::size_t columns);

}  // namespace tern
