// Every message of a log that its receivers would accept, whatever its type.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "flight_log/flight_log.h"
#include "tools/export/message_json.h"

namespace tern::exporting {

struct LoggedMessage {
  std::string channel;  ///< on the wire, suffix included
  std::string type;     ///< "plan_t"
  std::int64_t received_us = 0;
  Json fields;  ///< message_json()
};

/// Asks `log` for all of Tern's channels. @param suffix  that `log` was made with
void on_every_channel(FlightLog& log, const std::string& suffix, std::function<void(const LoggedMessage&)> use);

}  // namespace tern::exporting
