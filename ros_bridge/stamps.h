// Times of ROS's messages, and whether they can be believed.
#pragma once

#include <fmt/format.h>

#include "core/base/result.h"
#include "core/base/time.h"
#include "ros_messages/types.h"

namespace tern::ros {

/// A stamp may be this far ahead of the own clock, as in all messages of Tern.
inline constexpr Duration kMaxAhead{100'000};

/// Returns the time of a stamp, rounded down to microseconds.
inline UTime time_of(const ros::Time& stamp) { return {stamp.sec * std::int64_t{1'000'000} + stamp.nanosec / 1'000}; }

/// Refuses stamps that are older than `oldest` or more than `ahead` in the future.
inline Result<void> check_stamp(UTime at, UTime now, Duration oldest, Duration ahead = kMaxAhead) {
  const Duration age = now - at;
  if (age <= oldest && age >= Duration{-ahead.us}) return {};
  return fail(
      fmt::format("its stamp is {:.3f} s {}; clocks must agree, and ROS's use_sim_time be false unless the flight is "
                  "slowed",
                  std::abs(age.seconds()), age.us > 0 ? "old" : "ahead"));
}

}  // namespace tern::ros
