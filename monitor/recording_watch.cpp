#include "monitor/recording_watch.h"

#include <fmt/format.h>

#include <algorithm>

namespace tern {

void RecordingWatch::receive(const Heartbeat& heartbeat) {
  const UTime at = heartbeat.header.utime;
  newest_ = std::max(newest_, at);
  if (heartbeat.process != kLoggerProcess) return;
  if (trouble_.empty()) trouble_ = silence(at);
  if (heartbeat.state == ProcessState::Failed) trouble_ = heartbeat.waiting_for;
  logger_heard_ = at;
}

std::string RecordingWatch::gap() const { return trouble_.empty() ? silence(newest_) : trouble_; }

std::string RecordingWatch::silence(UTime until) const {
  if (!logger_heard_ || until - *logger_heard_ <= kLoggerSilence) return "";
  return fmt::format("{} was silent for {:.1f} s", kLoggerProcess, (until - *logger_heard_).seconds());
}

}  // namespace tern
