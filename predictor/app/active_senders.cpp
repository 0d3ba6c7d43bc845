#include "predictor/app/active_senders.h"

#include <fmt/format.h>

namespace tern {

std::string ActiveSenders::refusal(std::int32_t sensor_id, std::int64_t epoch_us, UTime now) {
  std::erase_if(senders_, [now](const auto& entry) { return now - entry.second.at > kSensorSilence; });
  if (senders_.size() >= kMaxSensors && !senders_.contains(sensor_id))
    return fmt::format("not used, since {} sensors send already (does each frame have an id?)", kMaxSensors);
  Sender& sender = senders_.try_emplace(sensor_id, Sender{epoch_us, now}).first->second;
  if (sender.epoch_us != epoch_us)
    return "a second process sends sets, which are not used (do two sensors have one id?)";
  sender.at = now;
  return "";
}

}  // namespace tern
