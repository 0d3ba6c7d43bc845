// The messages HEARTBEAT and CONFIGURATION: the state of each process, and the configuration that it runs with.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/wire/header.h"

namespace tern {

/// The state of a process.
enum class ProcessState : std::uint8_t { Starting = 0, Waiting = 1, Ready = 2, Finished = 3, Failed = 4 };

/// The reason why a received message was refused.
enum class Rejection : std::uint8_t {
  Length = 0,        ///< its length is not the one that its counts require
  Fingerprint = 1,   ///< it is of another type, or of another version of the type
  Count = 2,         ///< a count is negative or beyond its limit
  Number = 3,        ///< a number is not finite or outside its range
  Enumeration = 4,   ///< a value of an enumeration is unknown
  Time = 5,          ///< times are out of order or outside their range
  Inconsistent = 6,  ///< fields contradict each other
  Future = 7,        ///< it claims a time too far ahead of the receiver's clock
  Sender = 8,        ///< another sender is accepted on this channel, or its named sender cannot have sent it
  Repeated = 9,      ///< it was received already; with keys also: it is too old.
  /// With keys only (runtime/authentication.h): the tag is missing, or its role's key gives another one.
  Unauthenticated = 10,
};
inline constexpr int kRejections = 11;

/// Counters of one channel in one process.
struct ChannelCounters {
  std::int64_t sent = 0;
  std::int64_t received = 0;                ///< accepted messages
  std::int64_t rejected[kRejections] = {};  ///< refused messages, by Rejection
  std::int64_t lost = 0;                    ///< messages missing by their sequence numbers
  std::int64_t late = 0;                    ///< accepted messages that were too old to be used
};

/// Times of the newest heartbeat that was received from another process. From its echo, that process computes the
/// offset of the two clocks (runtime/clock_exchange.h).
struct ClockEcho {
  std::int64_t sender_epoch_us = 0;  ///< names the other process
  UTime sent;                        ///< `utime` of its heartbeat, by its clock
  UTime received;                    ///< when the heartbeat was received, by the own clock
};

/// HEARTBEAT: how a process is.
struct Heartbeat {
  Header header;
  std::string process;  ///< "tern-planner"
  std::string build_id;
  ProcessState state = ProcessState::Starting;
  std::string waiting_for;  ///< Waiting: for what; Ready: warnings; Failed: the reason; may be empty
  std::map<std::string, ChannelCounters> channels;
  std::vector<ClockEcho> echoes;  ///< in ascending order of their epochs
};

/// CONFIGURATION: what a process runs with.
struct ConfigurationReport {
  Header header;
  std::string process;
  std::string build_id;
  std::string platform;    ///< compiler, CPU features, C library, BLAS: floating-point results depend on them
  std::string yaml;        ///< the effective configuration
  std::uint64_t hash = 0;  ///< digest of yaml
};

}  // namespace tern
