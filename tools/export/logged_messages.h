// Reads all of Tern's messages in a log, of any type, as bytes.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "flight_log/flight_log.h"
#include "messages/codec.h"

namespace tern::exporting {

/// One message that its receivers would accept.
struct LoggedMessage {
  std::string channel;  ///< on the wire, suffix included
  std::string type;     ///< "plan_t"
  std::int64_t received_us = 0;
  Bytes bytes;  ///< as encode() makes them
};

/// Registers `use` for all of Tern's channels in `log`. @param suffix  the one that `log` was made with
void on_every_channel(FlightLog& log, const std::string& suffix, std::function<void(const LoggedMessage&)> use);

}  // namespace tern::exporting
