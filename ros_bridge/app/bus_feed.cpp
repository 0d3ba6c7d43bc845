#include "ros_bridge/app/bus_feed.h"

#include <utility>

#include "messages/batching.h"
#include "messages/channels.h"
#include "runtime/log.h"

namespace tern::ros {

BusFeed::BusFeed(Bus& bus, Feed& feed) {
  using namespace channels;
  bus.subscribe(kUavState, [&feed](const UavState& state) { feed.receive(state); });
  bus.subscribe(kSetpoint, [&feed](const UavState& setpoint) { feed.receive_setpoint(setpoint); });
  bus.subscribe(kVehicleStatus, [&feed](const VehicleStatus& status) { feed.receive(status); });
  bus.subscribe(kObstacleObservations, [&feed](const ObservationSet& frame) { feed.receive(frame); });
  bus.subscribe(kGoal, [&feed](const Goal& goal) { feed.receive(goal); });
  bus.subscribe(kHorizonRequest, [&feed](const HorizonRequest& request) { feed.receive(request); });
  bus.subscribe(kPlan, [&feed](const Plan& plan) { feed.receive(plan); });
  bus.subscribe(kObstacleTruth, [this, &feed](const ObstacleTruth& batch) {
    if (auto batches = truth_.add(batch)) feed.receive(join_batches(std::move(*batches)));
  });
  bus.subscribe(kPredictions, [this, &feed](const TrackSet& batch) {
    if (auto batches = tracks_.add(batch)) feed.receive(join_batches(std::move(*batches)));
  });
  bus.subscribe(kSemanticMap, [this, &feed](const MapChunk& chunk) {
    const auto complete = maps_.add(chunk);
    if (!complete) log::warn("{}", complete.error().message);
    if (complete && *complete) feed.receive(maps_.take(), chunk.header.utime);
  });
}

}  // namespace tern::ros
