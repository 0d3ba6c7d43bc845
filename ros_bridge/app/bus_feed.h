// The messages of the bus as a feed of ROS messages.
#pragma once

#include "core/world/voxel_map.h"
#include "messages/codec.h"
#include "ros_messages/feed.h"
#include "runtime/batches.h"
#include "runtime/bus.h"

namespace tern::ros {

/// Subscribes all channels that a feed reads, and hands it complete messages: joined batches, whole maps.
class BusFeed {
 public:
  /// @param feed  outlives this object
  BusFeed(Bus& bus, Feed& feed);
  BusFeed(const BusFeed&) = delete;
  BusFeed& operator=(const BusFeed&) = delete;

 private:
  BatchCollector<ObstacleTruth> truth_;
  BatchCollector<TrackSet> tracks_;
  MapAssembler maps_;
};

}  // namespace tern::ros
