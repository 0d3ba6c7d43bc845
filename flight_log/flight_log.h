// A recorded flight as typed messages, read from all parts of its log. Messages that could not be used are counted.
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
#include "core/wire/header.h"
#include "core/wire/health.h"
#include "core/wire/message_losses.h"
#include "flight_log/log_reader.h"
#include "messages/codec.h"

namespace tern {

/// The content of a log on one channel.
struct LogChannel {
  std::int64_t messages = 0, bytes = 0;    ///< all messages
  std::int64_t refused[kRejections] = {};  ///< by Rejection; Fingerprint also counts bytes that are no message
  std::int64_t lost = 0;                   ///< lost messages by their sequence numbers (MessageLosses)
  std::int64_t before_first = 0;           ///< messages that were sent before the first one in the log
  std::int64_t repeated = 0;               ///< messages that the network delivered again.
  /// True if the channel has a handler. Only then its messages are decoded, and `refused`, `lost`, `repeated` are
  /// known.
  bool read = false;
  bool foreign = false;  ///< it is not one of Tern's channels

  /// Returns the number of refused messages.
  [[nodiscard]] std::int64_t refused_total() const {
    return std::accumulate(std::begin(refused), std::end(refused), std::int64_t{0});
  }
};

/// LCM's own message at its start, on a channel of this name. It is part of every healthy log.
inline constexpr char kLcmSelfTest[] = "LCM_SELF_TEST";

/// A log that holds no message for this long is silent: in a flight every process sends a HEARTBEAT each half second.
inline constexpr Duration kLogSilence{1'000'000};

/// The content of a log.
struct LogContents {
  std::vector<std::string> parts;          ///< the files, in order
  std::int64_t events = 0;                 ///< complete events
  std::int64_t first_us = 0, last_us = 0;  ///< when the first and the last were received, µs since the Unix epoch

  /// The spans between silences: first and last time, µs since the Unix epoch; ascending.
  std::vector<std::pair<std::int64_t, std::int64_t>> spans;
  LogDamage damage;  ///< of all parts together; `truncated` is that of the last part.
  /// Between which receive times damaged places lie, µs since the Unix epoch, in the log's order. INT64_MIN and
  /// INT64_MAX stand for the log's beginning and end.
  std::vector<std::pair<std::int64_t, std::int64_t>> damaged;
  std::vector<std::string> missing_parts;      ///< missing_log_parts()
  std::map<std::string, LogChannel> channels;  ///< by name on the wire, including the suffix
};

/// Returns the files of a log in their order: `path` (or flight.lcm in the folder `path`), then the further parts that
/// tern-logger wrote. A missing number does not end the list.
std::vector<std::string> log_parts(const std::string& path);

/// Returns the parts that are missing between those of log_parts(), in words: "flight.001.lcm" or "flight.001.lcm to
/// flight.004.lcm".
std::vector<std::string> missing_log_parts(const std::string& path);

/// Passes the messages of a log to handlers of their channels, in the log's order.
///
///     FlightLog log;
///     log.on(channels::kPlan, [&](const Plan& plan, std::int64_t received_us) { … });
///     const Result<LogContents> contents = log.read("flight.lcm");
///
/// Handlers get only messages that decode() accepts. A message that the network delivered again, among the newest 4096
/// of its channel, is passed on once. Memory is bounded: one event is held at a time (LogReader).
class FlightLog {
 public:
  /// @param suffix  the suffix of the vehicle's channels; may be empty
  explicit FlightLog(std::string suffix = "") : suffix_(std::move(suffix)) {}

  /// Adds a handler of a channel. Several handlers of one channel are called in the order in which they were added.
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

  /// Reads all parts of a log, or a text log (text_log.h). A second call reads them again. An exception of a handler
  /// ends the reading and is passed on. @return an Error if a part cannot be opened
  Result<LogContents> read(const std::string& path);

 private:
  using Handler = std::function<tl::expected<Header, Rejection>(std::span<const std::uint8_t>, std::int64_t)>;
  struct Reading;
  void add(std::string_view channel, Handler handler);

  std::string suffix_;
  std::map<std::string, std::vector<Handler>> handlers_;  ///< by name on the wire
};

}  // namespace tern
