// The part of a flight's summary that the page shows beside its log.
#pragma once

#include <string>

namespace tern {

/// From summary.json in the log's folder.
struct FlightNote {
  double pace = 1.0;  ///< seconds of flight per second of the system's clock, (0, 1]
  std::string why;    ///< the sentence on the cause of a flight that was held or ended early; empty: none
};

/// Reads the summary beside a log. Without a readable one, or for a value of another kind, the defaults are returned.
/// @param log  a file, or a flight's folder
FlightNote read_flight_note(const std::string& log);

}  // namespace tern
