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

/// Subscribes to scans and collects them. Messages of one sensor are one scan if they agree in time, position, range
/// and has_classes. It is complete when another message arrives, or kScanParts after its last message. So a voxel that
/// is hit in one part is not freed by rays of another part.
class LiveIntake {
 public:
  explicit LiveIntake(Bus& bus);

  /// Adds the complete scans to the map, the newest kMaxScanPoints points of them. Older scans are left out and
  /// counted: the time of one step is bounded, and HEARTBEAT goes on in a flood. @return how many were added
  int add_to(LiveMap& map, UTime now);
  /// The number of scans that were left out so far.
  [[nodiscard]] std::int64_t left_out() const { return left_out_; }
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
  std::int64_t left_out_ = 0;
};

/// A scan is complete this long after its last message.
inline constexpr Duration kScanParts{50'000};
/// Messages are joined to scans for at most this many sensors. Each message of a further sensor is a scan by itself.
inline constexpr std::size_t kMaxSensors = 16;
/// A scan has at most this many points, those of a depth image of 1280 × 800; further messages begin a new one. One
/// step adds at least one scan, and further ones while they have no more points than this together.
inline constexpr std::size_t kMaxScanPoints = 1'024'000;

}  // namespace tern
