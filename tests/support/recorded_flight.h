// Flights on virtual time recorded as logs, and copies of logs with one change.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/time.h"
#include "messages/codec.h"

namespace tern::testing {

/// Returns the log of a flight that several tests share. ctest records it before them
/// (tests/flights/record_flights.cpp). @throws std::runtime_error if it is missing
std::string recorded_log(const std::string& name);

/// Flies a scenario file on virtual time and records every message as tern-logger would. The log ends a second after
/// the verdict.
/// @param start  the time at which virtual time begins
/// @throws std::runtime_error if writing the log fails or the flight is endless
void record_flight(const std::string& scenario_file, const std::vector<std::string>& overrides, const std::string& log,
                   UTime start = UTime{1'000'000});

/// A change of an event: it may change the bytes; empty bytes leave the event out.
using ChangeBytes = std::function<void(std::string_view channel, std::vector<std::uint8_t>& bytes)>;
/// Copies a log and changes its events.
void copy_log(const std::string& from, const std::string& to, const ChangeBytes& change);

/// Copies the events received in [from_us, to_us), like a logger that started late or died.
void copy_part_of_log(const std::string& from, const std::string& to, std::int64_t from_us, std::int64_t to_us);
/// Copies a log without the events received in [from_us, to_us), like a logger that was away.
void copy_log_without(const std::string& from, const std::string& to, std::int64_t from_us, std::int64_t to_us);
/// Copies a log with every event `times` times, like a network that repeats messages.
void copy_log_repeated(const std::string& from, const std::string& to, int times);
/// Concatenates logs.
void join_logs(const std::vector<std::string>& from, const std::string& to);

/// Copies a log and changes the messages of one channel; messages for which `change` returns false are left out.
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
