#include "viewer/bridge/app/scene_intake.h"

#include <tuple>
#include <type_traits>

#include "messages/batching.h"
#include "messages/codec.h"
#include "runtime/log.h"
#include "viewer/bridge/app/foxglove_link.h"

namespace tern {

namespace {

using namespace channels;

/// The channels that the page shows.
constexpr std::tuple kShown{
    kUavState,  kVehicleTruth,  kObstacleTruth, kObstacleObservations, kPredictions, kHorizonRequest,
    kPlan,      kPlanTiming,    kSearchView,    kSemanticMap,          kGoal,        kFlightResult,
    kHeartbeat, kConfiguration, kPlanHeading,   kObstacleSightings,    kOdometry,    kFeatureTracks};

}  // namespace

void SceneIntake::subscribe(Bus& bus) {
  const auto subscribe_to = [this, &bus]<class T>(const Channel<T>& channel) {
    bus.subscribe(channel, [this, &bus, &channel](const T& message) { take(channel, message, bus.clock().now()); });
  };
  link_ != nullptr ? for_each_channel(subscribe_to) : for_each_channel(subscribe_to, kShown);
}

bool SceneIntake::receive(std::string_view channel, std::span<const std::uint8_t> bytes, UTime at) {
  bool accepted = true;
  const auto read = [&]<class T>(const Channel<T>& known) {
    const auto message = decode<T>(bytes);
    accepted = message.has_value();
    if (accepted) take(known, *message, at);
  };
  link_ != nullptr ? visit_channel(channel, read) : visit_channel(channel, read, kShown);
  return accepted;
}

template <class T>
void SceneIntake::take(const Channel<T>& channel, const T& message, UTime at) {
  if (link_ != nullptr) {
    link_->set_time(at);
    link_->take(channel, message);
  }
  show(channel, message, at);
}

template <class T>
void SceneIntake::feed(const T& complete) {
  if (link_ != nullptr) link_->feed().receive(complete);
}

template <class T>
void SceneIntake::show(const Channel<T>& channel, const T& message, UTime at) {
  if constexpr (std::is_same_v<T, ObstacleTruth>) {
    if (auto batches = truth_.add(message)) {
      const ObstacleTruth whole = join_batches(std::move(*batches));
      feed(whole);
      scene_.receive(whole);
    }
  } else if constexpr (std::is_same_v<T, TrackSet>) {
    if (std::string_view(channel.name) != kPredictions.name) return;
    if (auto batches = tracks_.add(message)) {
      TrackSet whole = join_batches(std::move(*batches));
      feed(whole);
      scene_.receive(std::move(whole));
    }
  } else if constexpr (std::is_same_v<T, MapChunk>) {
    const auto complete = maps_.add(message);
    if (!complete) log::warn("{}", complete.error().message);
    if (complete && *complete) {
      const VoxelMap map = maps_.take();
      if (link_ != nullptr) link_->feed().receive(map, message.header.utime);
      scene_.receive(map);
    }
  } else if constexpr (std::is_same_v<T, UavState>) {
    show_state(channel.name, message);
  } else if constexpr (std::is_same_v<T, Heartbeat>) {
    scene_.receive(message, at);
  } else {
    if constexpr (requires(ros::Feed & f) { f.receive(message); }) feed(message);
    if constexpr (requires { scene_.receive(message); }) scene_.receive(message);
  }
}

void SceneIntake::show_state(std::string_view channel, const UavState& state) {
  if (channel == kVehicleTruth.name) {
    scene_.receive_truth(state);
  } else if (channel == kUavState.name) {
    feed(state);
    scene_.receive(state);
  } else if (link_ != nullptr) {
    link_->feed().receive_setpoint(state);
  }
}

void SceneIntake::restart() {
  truth_ = {};
  tracks_ = {};
}

}  // namespace tern
