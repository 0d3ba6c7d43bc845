// Flights on virtual time recorded as logs, and logs with one thing changed.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "messages/codec.h"

namespace tern::testing {

/// Flies a scenario file on virtual time and records every message as tern-logger would. Ends a second after the
/// verdict. @throws std::runtime_error when the log cannot be written or the flight has no end.
void record_flight(const std::string& scenario_file, const std::vector<std::string>& overrides, const std::string& log);

/// What becomes of an event: its bytes may be changed; empty: it is left out.
using ChangeBytes = std::function<void(std::string_view channel, std::vector<std::uint8_t>& bytes)>;
/// Copies a log event by event.
void copy_log(const std::string& from, const std::string& to, const ChangeBytes& change);

/// Copies a log with the messages of one channel changed by `change`; those for which it returns false are left out.
template <class T>
void copy_log_with(const std::string& from, const std::string& to, std::string_view channel,
                   const std::function<bool(T&)>& change) {
  copy_log(from, to, [&](std::string_view name, std::vector<std::uint8_t>& bytes) {
    if (name != channel) return;
    auto message = decode<T>(bytes).value();
    bytes = change(message) ? encode(message) : std::vector<std::uint8_t>{};
  });
}

}  // namespace tern::testing
