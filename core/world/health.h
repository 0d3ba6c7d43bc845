// HEARTBEAT and CONFIGURATION: how each process is, and what it runs with.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/world/header.h"

namespace tern {

enum class ProcessState : std::uint8_t { Starting = 0, Waiting = 1, Ready = 2, Finished = 3, Failed = 4 };

/// Why a received message was refused.
enum class Rejection : std::uint8_t {
  Length = 0,        ///< not exactly the bytes that its counts ask for
  Fingerprint = 1,   ///< another type, or another version of it
  Count = 2,         ///< a count is negative or beyond its limit
  Number = 3,        ///< not finite, or a number beyond its range
  Enumeration = 4,   ///< an unknown value of an enumeration
  Time = 5,          ///< times out of order, or absurd
  Inconsistent = 6,  ///< fields contradict each other
  Future = 7,        ///< it claims a time that the listener's clock is far from
  Sender = 8,        ///< another sender is heard on this channel, or this one cannot have sent it
  Repeated = 9,      ///< it came already; with keys also: too long ago
  /// With keys only (runtime/authentication.h): no tag, or none that its role's key gives.
  Unauthenticated = 10,
};
inline constexpr int kRejections = 11;

/// Counters of one channel as one process saw it.
struct ChannelCounters {
  std::int64_t sent = 0;
  std::int64_t received = 0;                ///< accepted
  std::int64_t rejected[kRejections] = {};  ///< by Rejection
  std::int64_t lost = 0;                    ///< gaps in sequence numbers
  std::int64_t late = 0;                    ///< accepted but too old to be used
};

/// The newest heartbeat heard of another process: by it that one compares the clocks (runtime/clock_exchange.h).
struct ClockEcho {
  std::int64_t sender_epoch_us = 0;  ///< that process
  UTime sent;                        ///< its heartbeat's utime, its clock
  UTime received;                    ///< own clock
};

struct Heartbeat {
  Header header;
  std::string process;  ///< "tern-planner"
  std::string build_id;
  ProcessState state = ProcessState::Starting;
  std::string waiting_for;  ///< what it waits for, in words; empty when nothing
  std::map<std::string, ChannelCounters> channels;
  std::vector<ClockEcho> echoes;  ///< by epoch ascending
};

struct ConfigurationReport {
  Header header;
  std::string process;
  std::string build_id;
  std::string platform;    ///< compiler, CPU features, C library, BLAS: what floating point depends on besides
  std::string yaml;        ///< the effective configuration
  std::uint64_t hash = 0;  ///< digest of yaml
};

}  // namespace tern
