#include "viewer/bridge/app/scene_intake.h"

#include <tuple>
#include <type_traits>

#include "messages/batching.h"
#include "messages/codec.h"
#include "runtime/log.h"

namespace tern {

namespace {

using namespace channels;

/// The channels that the page shows.
constexpr std::tuple kShown{kUavState,       kVehicleTruth, kObstacleTruth, kObstacleObservations, kPredictions,
                            kHorizonRequest, kPlan,         kPlanTiming,    kSearchView,           kSemanticMap,
                            kGoal,           kFlightResult, kHeartbeat,     kConfiguration};

}  // namespace

void SceneIntake::subscribe(Bus& bus) {
  const auto subscribe_to = [this, &bus]<class T>(const Channel<T>& channel) {
    bus.subscribe(channel, [this, &bus, &channel](const T& message) { take(channel, message, bus.clock().now()); });
  };
  for_each_channel(subscribe_to, kShown);
}

bool SceneIntake::receive(std::string_view channel, std::span<const std::uint8_t> bytes, UTime at) {
  bool accepted = true;
  const auto read = [&]<class T>(const Channel<T>& known) {
    const auto message = decode<T>(bytes);
    accepted = message.has_value();
    if (accepted) take(known, *message, at);
  };
  visit_channel(channel, read, kShown);
  return accepted;
}

template <class T>
void SceneIntake::take(const Channel<T>& channel, const T& message, UTime at) {
  if constexpr (std::is_same_v<T, ObstacleTruth>) {
    if (auto batches = truth_.add(message)) scene_.receive(join_batches(std::move(*batches)));
  } else if constexpr (std::is_same_v<T, TrackSet>) {
    if (auto batches = tracks_.add(message)) scene_.receive(join_batches(std::move(*batches)));
  } else if constexpr (std::is_same_v<T, MapChunk>) {
    const auto complete = maps_.add(message);
    if (!complete) log::warn("{}", complete.error().message);
    if (complete && *complete) scene_.receive(maps_.take());
  } else if constexpr (std::is_same_v<T, UavState>) {
    const bool is_truth = std::string_view(channel.name) == kVehicleTruth.name;
    is_truth ? scene_.receive_truth(message) : scene_.receive(message);
  } else if constexpr (std::is_same_v<T, Heartbeat>) {
    scene_.receive(message, at);
  } else {
    scene_.receive(message);
  }
}

void SceneIntake::restart() {
  truth_ = {};
  tracks_ = {};
}

}  // namespace tern
