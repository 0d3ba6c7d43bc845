#include "executor/app/live_map_watch.h"

#include <fmt/format.h>

#include "messages/channels.h"
#include "runtime/log.h"

namespace tern {

void LiveMapWatch::add(const Heartbeat& heartbeat, UTime received) {
  if (heartbeat.process != "tern-mapper") return;
  const bool is_live = heartbeat.channels.contains(channels::kPointCloud.name);
  received_ = is_live ? std::optional(received) : std::nullopt;
  if (heartbeat.state == ProcessState::Ready) {
    waiting_for_ = "";
  } else {
    waiting_for_ = heartbeat.waiting_for.empty() ? "its start" : heartbeat.waiting_for;
  }
}

std::string LiveMapWatch::trouble(UTime now) const {
  if (!received_) return "";
  if (now > *received_ + kMaxAge)
    return fmt::format("the live map is not kept up to date: tern-mapper is silent for {:.1f} s",
                       (now - *received_).seconds());
  return waiting_for_.empty() ? "" : "the live map is not kept up to date: tern-mapper waits for " + waiting_for_;
}

bool LiveMapWatch::judge(UTime now) {
  const std::string why = trouble(now);
  if (why.empty() && !was_kept_) log::info("plans are requested again: the live map is kept up to date");
  if (!why.empty() && was_kept_) log::warn("no plans are requested: {}", why);
  was_kept_ = why.empty();
  return was_kept_;
}

}  // namespace tern
