// How much of its flight a log holds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/audit/flight_record.h"

namespace tern::audit {

/// The part of a flight that its log holds. Times are seconds since the flight's start (FlightRecord::zero()).
struct LogSpan {
  bool began = false;               ///< the log holds a part of a flight
  double from_s = 0.0, to_s = 0.0;  ///< the log's first and last message
  std::optional<double> flight_s;   ///< length of the flight, by FLIGHT_RESULT or by the summary beside the log
  std::vector<std::string> gaps;    ///< the missing parts of the flight, in words
};

/// Returns the span. The log lacks a part if
/// - its first request is not the executor's first,
/// - it ends before the flight: without FLIGHT_RESULT though a simulator flew, or while the vehicle flies,
/// - it holds no message for kLogSilence, or no state of the vehicle for 0.3 s at the judged time's start or end,
/// - it holds no state for kLogSilence at the end of a log without FLIGHT_RESULT,
/// - the vehicle's motion has holes of more than 0.3 s, or no state at all,
/// - every message of a channel that is judged was refused,
/// - messages are missing by the event numbers, or a part of the log by its number, or
/// - the log is damaged within the flight.
LogSpan span_of(const FlightRecord& record);

/// Returns "it reaches from -0.31 to 1.20 s of a flight of 13.25 s".
std::string to_text(const LogSpan& span);

}  // namespace tern::audit
