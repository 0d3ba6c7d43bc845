// What the message tests know of each type, and the comparison of values field by field.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "messages/codec.h"

namespace tern {

using AllMessages =
    testing::Types<UavState, VehicleStatus, ObservationSet, TrackSet, MapChunk, Goal, HorizonRequest, Plan, PlanTiming,
                   SearchView, TrackBounds, Heartbeat, ConfigurationReport, ObstacleTruth, FlightResult>;

/// The sizes of a value's arrays, in the order in which its .lcm file declares the counts.
template <class T>
std::vector<std::int32_t> array_sizes(const T& value);

/// Every field as 64-bit words, floating point by its bits: two values are the same if and only if their words are.
template <class T>
std::vector<std::uint64_t> words_of(const T& value);

}  // namespace tern
