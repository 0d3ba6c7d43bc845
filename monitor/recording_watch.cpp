#include "monitor/recording_watch.h"

#include <fmt/format.h>

#include <algorithm>

namespace tern {

void RecordingWatch::receive(const Heartbeat& heartbeat) {
  const UTime at = heartbeat.header.utime;
  newest_ = std::max(newest_, at);
  if (heartbeat.process != kLoggerProcess) return;
  const std::int64_t epoch_us = heartbeat.header.name.sender_epoch_us;
  if (has_begun_ && logger_heard_ && epoch_us != logger_epoch_us_) {
    if (epoch_us > logger_epoch_us_ && !successor_heard_) successor_heard_ = at;
    return;
  }
  logger_epoch_us_ = std::max(logger_epoch_us_, epoch_us);
  if (trouble_.empty()) trouble_ = silence(at);
  if (heartbeat.state == ProcessState::Failed) trouble_ = heartbeat.waiting_for;
  logger_heard_ = at;
}

std::string RecordingWatch::gap() const {
  if (!trouble_.empty()) return trouble_;
  if (successor_heard_ && *successor_heard_ > *logger_heard_) {
    return fmt::format("{} restarted during the flight", kLoggerProcess);
  }
  return silence(newest_);
}

std::string RecordingWatch::silence(UTime until) const {
  if (!logger_heard_ || until - *logger_heard_ <= kLoggerSilence) return "";
  return fmt::format("{} was silent for {:.1f} s", kLoggerProcess, (until - *logger_heard_).seconds());
}

}  // namespace tern
