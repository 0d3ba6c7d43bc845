// Whether tern-logger recorded a flight as a whole, by its heartbeats.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/wire/health.h"

namespace tern {

inline constexpr char kLoggerProcess[] = "tern-logger";
/// Four heartbeats may be lost. A logger that is restarted at once is back earlier.
inline constexpr Duration kLoggerSilence{2'500'000};

/// The recording of a flight is incomplete in three cases. Times are those in the heartbeats.
/// - The logger reports messages that are not in its log.
/// - It is silent for kLoggerSilence.
/// - After begin() another logger follows it: what the first one had not written is lost. One beside it changes
/// nothing.
class RecordingWatch {
 public:
  void receive(const Heartbeat& heartbeat);
  /// The flight begins. Its logger is the one that was started last.
  void begin() { has_begun_ = true; }
  /// Returns whether a logger was heard at all.
  [[nodiscard]] bool is_recorded() const { return logger_heard_.has_value(); }
  /// Returns why the recording is incomplete; empty if it is whole.
  [[nodiscard]] std::string gap() const;

 private:
  [[nodiscard]] std::string silence(UTime until) const;

  bool has_begun_ = false;
  std::int64_t logger_epoch_us_ = 0;  ///< of the flight's logger; 0: none yet
  std::optional<UTime> logger_heard_;
  std::optional<UTime> successor_heard_;  ///< the first heartbeat of a logger that was started after begin()
  UTime newest_;
  std::string trouble_;
};

}  // namespace tern
