// The properties of each message type for the tests, and the comparison of values field by field.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "messages/codec.h"

namespace tern {

using AllMessages =
    testing::Types<UavState, VehicleStatus, ObservationSet, SightingSet, CloudScan, DepthImage, TrackSet, MapChunk,
                   Goal, HorizonRequest, Plan, PlanHeading, PlanTiming, PlanUnseen, PoseError, LandmarkDensities,
                   SearchView, TrackBounds, Heartbeat, ConfigurationReport, ObstacleTruth, ImuBatch, FeatureFrame,
                   PositionFix, Odometry, FlightResult, MapFile, SpeedLimit, FenceSet>;

/// Returns the sizes of a value's arrays, in the order in which its .lcm file declares the counts.
template <class T>
std::vector<std::int32_t> array_sizes(const T& value);

/// Returns every field as 64-bit words, floating point by its bits. Two values are equal exactly if their words are.
template <class T>
std::vector<std::uint64_t> words_of(const T& value);

}  // namespace tern
