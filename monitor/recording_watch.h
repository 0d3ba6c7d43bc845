// Whether tern-logger recorded a flight as a whole, by its heartbeats.
#pragma once

#include <optional>
#include <string>

#include "core/wire/health.h"

namespace tern {

inline constexpr char kLoggerProcess[] = "tern-logger";
/// Four heartbeats may be lost. A logger that is restarted at once is back earlier.
inline constexpr Duration kLoggerSilence{2'500'000};

/// The recording of a flight is incomplete if the logger reports messages that are not in its log, or is silent for
/// kLoggerSilence. Times are those in the heartbeats.
class RecordingWatch {
 public:
  void receive(const Heartbeat& heartbeat);
  /// Returns whether a logger was heard at all.
  [[nodiscard]] bool is_recorded() const { return logger_heard_.has_value(); }
  /// Returns why the recording is incomplete; empty if it is whole.
  [[nodiscard]] std::string gap() const;

 private:
  [[nodiscard]] std::string silence(UTime until) const;

  std::optional<UTime> logger_heard_;
  UTime newest_;
  std::string trouble_;
};

}  // namespace tern
