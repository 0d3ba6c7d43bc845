// What the message tests know of each type, and the comparison of values field by field.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

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

namespace tern {

using AllMessages = testing::Types<UavState, ObservationSet, TrackSet, MapChunk, Goal, HorizonRequest, Plan, PlanTiming,
                                   SearchView, Heartbeat, ConfigurationReport, ObstacleTruth, FlightResult>;

/// The sizes of a value's arrays, in the order in which its .lcm file declares the counts.
template <class T>
std::vector<std::int32_t> array_sizes(const T& value);

/// Every field as 64-bit words, floating point by its bits: two values are the same if and only if their words are.
template <class T>
std::vector<std::uint64_t> words_of(const T& value);

}  // namespace tern
