#include "tools/export/logged_messages.h"

#include <utility>

#include "messages/configuration_report.h"
#include "messages/flight_result.h"
#include "messages/goal.h"
#include "messages/heartbeat.h"
#include "messages/horizon_request.h"
#include "messages/map_chunk.h"
#include "messages/observation_set.h"
#include "messages/obstacle_truth.h"
#include "messages/plan.h"
#include "messages/plan_timing.h"
#include "messages/search_view.h"
#include "messages/track_set.h"
#include "messages/uav_state.h"
#include "runtime/channels.h"

namespace tern::exporting {

void on_every_channel(FlightLog& log, const std::string& suffix, std::function<void(const LoggedMessage&)> use) {
  // What was accepted is encoded again: the log hands over values, and a definition describes bytes.
  const auto ask = [&]<class T>(const char* channel, const char* type, const T& /*of this type*/) {
    log.on<T>(channel, [use, name = channel + suffix, type](const T& message, std::int64_t received_us) {
      use({name, type, received_us, message_json(type, encode(message))});
    });
  };
  ask(channels::kUavState, "uav_state_t", UavState{});
  ask(channels::kSetpoint, "uav_state_t", UavState{});
  ask(channels::kObstacleObservations, "observation_set_t", ObservationSet{});
  ask(channels::kDeclaredMotions, "track_set_t", TrackSet{});
  ask(channels::kPredictions, "track_set_t", TrackSet{});
  ask(channels::kSemanticMap, "map_chunk_t", MapChunk{});
  ask(channels::kGoal, "goal_t", Goal{});
  ask(channels::kHorizonRequest, "horizon_request_t", HorizonRequest{});
  ask(channels::kPlan, "plan_t", Plan{});
  ask(channels::kPlanTiming, "plan_timing_t", PlanTiming{});
  ask(channels::kSearchView, "search_view_t", SearchView{});
  ask(channels::kHeartbeat, "heartbeat_t", Heartbeat{});
  ask(channels::kConfiguration, "configuration_t", ConfigurationReport{});
  ask(channels::kObstacleTruth, "obstacle_truth_t", ObstacleTruth{});
  ask(channels::kFlightResult, "flight_result_t", FlightResult{});
}

}  // namespace tern::exporting
