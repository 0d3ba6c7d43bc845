#include "viewer/bridge/app/scene_intake.h"

#include <type_traits>

#include "messages/batching.h"
#include "messages/configuration_report.h"
#include "messages/flight_result.h"
#include "messages/goal.h"
#include "messages/heartbeat.h"
#include "messages/horizon_request.h"
#include "messages/map_chunk.h"
#include "messages/obstacle_truth.h"
#include "messages/plan.h"
#include "messages/plan_timing.h"
#include "messages/search_view.h"
#include "messages/track_set.h"
#include "messages/uav_state.h"
#include "runtime/channels.h"

namespace tern {

/// Calls visit(channel, std::type_identity<message>) for each channel that the page shows.
template <class Visit>
void SceneIntake::for_each_channel(Visit&& visit) {
  visit(channels::kUavState, std::type_identity<UavState>());
  visit(channels::kObstacleTruth, std::type_identity<ObstacleTruth>());
  visit(channels::kPredictions, std::type_identity<TrackSet>());
  visit(channels::kHorizonRequest, std::type_identity<HorizonRequest>());
  visit(channels::kPlan, std::type_identity<Plan>());
  visit(channels::kPlanTiming, std::type_identity<PlanTiming>());
  visit(channels::kSearchView, std::type_identity<SearchView>());
  visit(channels::kSemanticMap, std::type_identity<MapChunk>());
  visit(channels::kGoal, std::type_identity<Goal>());
  visit(channels::kFlightResult, std::type_identity<FlightResult>());
  visit(channels::kHeartbeat, std::type_identity<Heartbeat>());
  visit(channels::kConfiguration, std::type_identity<ConfigurationReport>());
}

void SceneIntake::subscribe(Bus& bus) {
  for_each_channel([&]<class T>(const char* channel, std::type_identity<T>) {
    bus.subscribe<T>(channel, [this, &bus](const T& message) { take(message, bus.clock().now()); });
  });
}

bool SceneIntake::hear(std::string_view channel, std::span<const std::uint8_t> bytes, UTime at) {
  bool accepted = true;
  for_each_channel([&]<class T>(const char* name, std::type_identity<T>) {
    if (channel != name) return;
    const auto message = decode<T>(bytes);
    accepted = message.has_value();
    if (accepted) take(*message, at);
  });
  return accepted;
}

template <class T>
void SceneIntake::take(const T& message, UTime at) {
  if constexpr (std::is_same_v<T, ObstacleTruth>) {
    if (auto batches = truth_.add(message)) scene_.hear(join_batches(std::move(*batches)));
  } else if constexpr (std::is_same_v<T, TrackSet>) {
    if (auto batches = tracks_.add(message)) scene_.hear(join_batches(std::move(*batches)));
  } else if constexpr (std::is_same_v<T, MapChunk>) {
    const auto complete = maps_.add(message);
    if (!complete) map_trouble_ = complete.error().message;
    if (complete && *complete) scene_.hear(maps_.take());
  } else if constexpr (std::is_same_v<T, Heartbeat>) {
    scene_.hear(message, at);
  } else {
    scene_.hear(message);
  }
}

void SceneIntake::restart() {
  truth_ = {};
  tracks_ = {};
}

}  // namespace tern
