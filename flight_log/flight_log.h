// A recorded flight as typed messages: every part of its log, and a count of all that could not be used.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/world/header.h"
#include "core/world/health.h"
#include "core/world/message_losses.h"
#include "flight_log/log_reader.h"
#include "messages/codec.h"

namespace tern {

/// What a log holds of one channel.
struct LogChannel {
  std::int64_t messages = 0, bytes = 0;    ///< all of them
  std::int64_t refused[kRejections] = {};  ///< by Rejection; Fingerprint: another version of the message, or no message
  std::int64_t lost = 0;                   ///< by its senders' numbers (MessageLosses)
  std::int64_t before_first = 0;           ///< what its senders had sent before the first message that the log has
  std::int64_t repeated = 0;               ///< the same bytes again: a network that delivers a message more than once
  bool read =
      false;  ///< it was asked for: only then its messages were decoded, and refused, lost and repeated are known
  bool foreign = false;  ///< not one of Tern's channels

  /// Refused, whatever the reason.
  [[nodiscard]] std::int64_t refused_total() const {
    return std::accumulate(std::begin(refused), std::end(refused), std::int64_t{0});
  }
};

/// What a log holds.
struct LogContents {
  std::vector<std::string> parts;              ///< the files, in order
  std::int64_t events = 0;                     ///< whole events
  std::int64_t first_us = 0, last_us = 0;      ///< when the earliest and latest was received, µs since the Unix epoch
  LogDamage damage;                            ///< of all parts together; truncated: the last one is
  std::map<std::string, LogChannel> channels;  ///< by name on the wire, suffix included
};

/// The files of a log: `path` (or flight.lcm in the folder `path`) and the parts that tern-logger wrote after it.
std::vector<std::string> log_parts(const std::string& path);

/// Hands a log's messages to those who ask for their channels, in the log's order.
///
///     FlightLog log;
///     log.on(channels::kPlan, [&](const Plan& plan, std::int64_t received_us) { … });
///     const Result<LogContents> contents = log.read("flight.lcm");
///
/// Bounded memory: no more than one event is held (LogReader). Only what decode() accepts is handed over. Each message,
/// by its name, is handed over once, however often the network delivered it among the newest 4096 of its channel.
class FlightLog {
 public:
  /// @param suffix  what the vehicle's channels end with, "" for none
  explicit FlightLog(std::string suffix = "") : suffix_(std::move(suffix)) {}

  /// Several handlers of one channel are called in the order of their asking.
  template <class T>
  void on(const Channel<T>& channel,
          std::type_identity_t<std::function<void(const T&, std::int64_t received_us)>> handler) {
    add(channel.name,
        [handler = std::move(handler)](std::span<const std::uint8_t> bytes,
                                       std::int64_t received_us) -> tl::expected<Header, Rejection> {
          const auto message = decode<T>(bytes);
          if (!message) return tl::make_unexpected(message.error());
          handler(*message, received_us);
          return message->header;
        });
  }

  /// Reads all parts once, or a text log (text_log.h). Can be called again, for a second pass. @return an Error when a
  /// part cannot be opened. What a handler throws ends the reading.
  Result<LogContents> read(const std::string& path);

 private:
  using Handler = std::function<tl::expected<Header, Rejection>(std::span<const std::uint8_t>, std::int64_t)>;
  struct Reading;
  void add(std::string_view channel, Handler handler);

  std::string suffix_;
  std::map<std::string, std::vector<Handler>> handlers_;  ///< by name on the wire
};

}  // namespace tern
