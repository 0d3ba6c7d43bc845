// Receives POINT_CLOUD and DEPTH_IMAGE, and joins the messages of one measurement to a scan.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/world/scan.h"
#include "runtime/bus.h"
#include "runtime/node.h"
#include "semantic_mapper/voxel_map/live_map.h"

namespace tern {

/// Returns the points of a depth image in W, one per measured pixel.
Scan scan_of(const DepthImage& image);
/// Returns the finite points of a cloud in W.
Scan scan_of(const CloudScan& cloud);

/// Subscribes to scans and collects them. Messages of one sensor with the same time are one scan. It is complete when a
/// message with another time arrives, or kScanParts after its last message. So a voxel that is hit in one part is not
/// freed by rays of another part.
class LiveIntake {
 public:
  explicit LiveIntake(Bus& bus);

  /// Adds the complete scans to the map. @return how many
  int add_to(LiveMap& map, UTime now);
  [[nodiscard]] std::int64_t scans() const { return scans_; }  ///< complete scans so far
  /// When the oldest scan is complete even without another message; kNever if none waits.
  [[nodiscard]] UTime next_complete() const;

 private:
  struct Pending {
    UTime at, received;
    Scan scan;
  };
  void receive(std::int32_t sensor, UTime at, Scan part);

  Bus& bus_;
  std::map<std::int32_t, Pending> pending_;  // by sensor
  std::vector<Scan> complete_;
  std::int64_t scans_ = 0;
};

/// A scan is complete this long after its last message.
inline constexpr Duration kScanParts{50'000};
/// The largest number of sensors of which scans are collected; of further ones, each message is a scan.
inline constexpr std::size_t kMaxSensors = 16;
/// A scan is complete with this many points: a depth image of 1280 × 800.
inline constexpr std::size_t kMaxScanPoints = 1'024'000;

}  // namespace tern
