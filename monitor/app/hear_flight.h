// The bus → a watch.
#pragma once

#include <tuple>

#include "monitor/flight_watch.h"
#include "runtime/bus.h"

namespace tern {

/// Hands `watch` all messages that it judges by; not OBSTACLE_TRUTH, which it only shows. Both must outlive the bus's
/// deliveries.
inline void hear_flight(Bus& bus, FlightWatch& watch) {
  constexpr std::tuple kJudged{channels::kHeartbeat,      channels::kUavState, channels::kGoal,
                               channels::kHorizonRequest, channels::kPlan,     channels::kPlanTiming,
                               channels::kFlightResult};
  const auto hear = [&]<class T>(const Channel<T>& channel) {
    bus.subscribe(channel, [&bus, &watch](const T& message) {
      if constexpr (requires { watch.hear(message, UTime{}); }) {
        watch.hear(message, bus.clock().now());
      } else {
        watch.hear(message);
      }
    });
  };
  for_each_channel(hear, kJudged);
}

}  // namespace tern
