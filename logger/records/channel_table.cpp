#include "logger/records/channel_table.h"

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

namespace tern {
namespace {

template <class T>
tl::expected<Header, Rejection> head_of(std::span<const std::uint8_t> bytes) {
  return decode<T>(bytes).map([](const T& message) { return message.header; });
}

}  // namespace

HeadDecoder find_head_decoder(std::string_view channel) {
  static const std::map<std::string_view, HeadDecoder> kDecoders = {
      {channels::kUavState, &head_of<UavState>},
      {channels::kSetpoint, &head_of<UavState>},
      {channels::kObstacleObservations, &head_of<ObservationSet>},
      {channels::kDeclaredMotions, &head_of<TrackSet>},
      {channels::kPredictions, &head_of<TrackSet>},
      {channels::kSemanticMap, &head_of<MapChunk>},
      {channels::kGoal, &head_of<Goal>},
      {channels::kHorizonRequest, &head_of<HorizonRequest>},
      {channels::kPlan, &head_of<Plan>},
      {channels::kPlanTiming, &head_of<PlanTiming>},
      {channels::kSearchView, &head_of<SearchView>},
      {channels::kHeartbeat, &head_of<Heartbeat>},
      {channels::kConfiguration, &head_of<ConfigurationReport>},
      {channels::kObstacleTruth, &head_of<ObstacleTruth>},
      {channels::kFlightResult, &head_of<FlightResult>},
  };
  const auto found = kDecoders.find(channel);
  return found == kDecoders.end() ? nullptr : found->second;
}

void ChannelTable::add(std::string_view name, UTime received, std::span<const std::uint8_t> data) {
  auto found = channels_.find(name);
  if (found == channels_.end()) {
    found = channels_.emplace(std::string(name), Channel{}).first;
    if (name.ends_with(suffix_)) found->second.decode = find_head_decoder(name.substr(0, name.size() - suffix_.size()));
  }
  Channel& channel = found->second;
  ++channel.count.received;
  channel.count.bytes += static_cast<std::int64_t>(data.size());
  if (channel.decode == nullptr) return;
  const auto head = channel.decode(data);
  if (!head) {
    ++channel.count.refused;
    return;
  }
  channel.losses.add(head->name, received);
  channel.count.lost = channel.losses.lost();
}

std::map<std::string, ChannelCount> ChannelTable::counts() const {
  std::map<std::string, ChannelCount> counts;
  for (const auto& [name, channel] : channels_) counts[name] = channel.count;
  return counts;
}

}  // namespace tern
