// Connects a bus to a FlightWatch.
#pragma once

#include <tuple>

#include "monitor/flight_watch.h"
#include "runtime/bus.h"

namespace tern {

/// The channels by which a FlightWatch judges, without VEHICLE_TRUTH (subscribed apart) and OBSTACLE_TRUTH (only
/// shown).
inline constexpr std::tuple kJudgedChannels{
    channels::kHeartbeat,   channels::kConfiguration,        channels::kUavState,
    channels::kGoal,        channels::kVehicleStatus,        channels::kHorizonRequest,
    channels::kPlan,        channels::kPlanTiming,           channels::kFlightResult,
    channels::kPredictions, channels::kObstacleObservations, channels::kOdometry,
    channels::kPlanUnseen};

/// Hands `watch` all messages by which it judges. `watch` must exist while the bus delivers messages.
inline void subscribe_flight(Bus& bus, FlightWatch& watch) {
  const auto subscribe = [&]<class T>(const Channel<T>& channel) {
    bus.subscribe(channel, [&bus, &watch](const T& message) {
      if constexpr (requires { watch.receive(message, UTime{}); }) {
        watch.receive(message, bus.clock().now());
      } else {
        watch.receive(message);
      }
    });
  };
  for_each_channel(subscribe, kJudgedChannels);
  bus.subscribe(channels::kVehicleTruth, [&watch](const UavState& truth) { watch.receive_truth(truth); });
}

}  // namespace tern
