// Which process may send the sets of each sensor.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "core/base/time.h"
#include "predictor/tracking/tracker.h"

namespace tern {

/// Another process may send a sensor's sets after the first one was silent for this long. So long a sensor counts.
inline constexpr Duration kSensorSilence{1'000'000};

/// One process per sensor_id, as on a channel with one sender, and at most kMaxSensors sensors at a time. Not
/// thread-safe.
class ActiveSenders {
 public:
  /// Notes a set. @return why it is not used, in words; "" if it is
  [[nodiscard]] std::string refusal(std::int32_t sensor_id, std::int64_t epoch_us, UTime now);

 private:
  struct Sender {
    std::int64_t epoch_us = 0;
    UTime at;
  };
  std::map<std::int32_t, Sender> senders_;  // by sensor; silent ones are removed
};

}  // namespace tern
