// Connects a bus to a FlightWatch.
#pragma once

#include <tuple>

#include "monitor/flight_watch.h"
#include "runtime/bus.h"

namespace tern {

/// Hands `watch` all messages by which it judges; not OBSTACLE_TRUTH, which is only shown. Both must outlive the bus's
/// deliveries.
inline void subscribe_flight(Bus& bus, FlightWatch& watch) {
  constexpr std::tuple kJudged{channels::kHeartbeat,      channels::kUavState, channels::kGoal,
                               channels::kHorizonRequest, channels::kPlan,     channels::kPlanTiming,
                               channels::kFlightResult};
  const auto subscribe = [&]<class T>(const Channel<T>& channel) {
    bus.subscribe(channel, [&bus, &watch](const T& message) {
      if constexpr (requires { watch.receive(message, UTime{}); }) {
        watch.receive(message, bus.clock().now());
      } else {
        watch.receive(message);
      }
    });
  };
  for_each_channel(subscribe, kJudged);
}

}  // namespace tern
