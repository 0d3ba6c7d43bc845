// Flights on virtual time recorded as logs, and logs with one thing changed.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/time.h"
#include "messages/codec.h"

namespace tern::testing {

/// The log of a flight that was recorded for several tests (tests/flights/record_flights.cpp), which ctest does before
/// them.
/// @throws std::runtime_error when it is not there.
std::string recorded_log(const std::string& name);

/// Flies a scenario file on virtual time and records every message as tern-logger would. Ends a second after the
/// verdict.
/// @param start  when its time begins
/// @throws std::runtime_error when the log cannot be written or the flight has no end.
void record_flight(const std::string& scenario_file, const std::vector<std::string>& overrides, const std::string& log,
                   UTime start = UTime{1'000'000});

/// What becomes of an event: its bytes may be changed; empty: it is left out.
using ChangeBytes = std::function<void(std::string_view channel, std::vector<std::uint8_t>& bytes)>;
/// Copies a log event by event.
void copy_log(const std::string& from, const std::string& to, const ChangeBytes& change);

/// Copies the events that were received in [from_us, to_us): as a logger that was not there before, or died.
void copy_part_of_log(const std::string& from, const std::string& to, std::int64_t from_us, std::int64_t to_us);
/// Copies a log without the events that were received in [from_us, to_us): as a logger that was away.
void copy_log_without(const std::string& from, const std::string& to, std::int64_t from_us, std::int64_t to_us);
/// Copies a log with every event `times` times: as a network that delivers each message so often.
void copy_log_repeated(const std::string& from, const std::string& to, int times);
/// One log after the other.
void join_logs(const std::vector<std::string>& from, const std::string& to);

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
