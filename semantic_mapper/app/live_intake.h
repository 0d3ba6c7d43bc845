// Receives POINT_CLOUD and DEPTH_IMAGE, and joins the messages of one measurement to a scan.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/world/scan.h"
#include "perception/frozen_check.h"
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
///
/// | a scan                                                       | effect                                         |
/// |--------------------------------------------------------------|------------------------------------------------|
/// | that is older than kOldestScan when it comes                 | not used: its rays would free what came since  |
/// | of a frozen sensor (FrozenCheck)                             | not used: its rays would free walls            |
/// | without a point from the least range on, as of a covered lens | not counted: it says nothing                  |
/// | before many newer ones                                       | left out and counted                           |
///
/// A scan whose points all lie beyond the range is a measurement: there is nothing up to the range.
class LiveIntake {
 public:
  explicit LiveIntake(Bus& bus);

  /// Adds the complete scans to the map, the newest kMaxScanPoints points of them. Older scans are left out and
  /// counted: the time of one step is bounded, and HEARTBEAT goes on in a flood.
  /// @return how many were added that have a point that counts
  int add_to(LiveMap& map, UTime now);
  /// The number of scans that were left out so far.
  [[nodiscard]] std::int64_t left_out() const { return left_out_; }
  /// When the oldest scan is complete even without another message; kNever if none waits.
  [[nodiscard]] UTime next_complete() const;
  /// Why a scan was not used in the last kScanTrouble, with its sensor; "" if all were.
  [[nodiscard]] std::string trouble() const;

 private:
  struct Pending {
    UTime at, received;
    Scan scan;
    MeasuredDepths measured;
  };
  struct Complete {
    std::int32_t sensor;
    Scan scan;
  };
  template <class M>
  void receive(const std::string& channel, const M& part);
  void finish(std::int32_t sensor, Pending pending);
  void note(std::string trouble);

  Bus& bus_;
  std::map<std::int32_t, Pending> pending_;  // by sensor
  std::vector<Complete> complete_;
  FrozenCheck frozen_;
  std::int64_t left_out_ = 0;
  std::string trouble_;
  std::optional<UTime> trouble_at_;
};

/// A scan that is older than this when it comes is not used.
inline constexpr Duration kOldestScan{1'000'000};
/// A trouble is named for this long after it happened last.
inline constexpr Duration kScanTrouble{2'000'000};
/// A scan is complete this long after its last message.
inline constexpr Duration kScanParts{50'000};
/// Messages are joined to scans for at most this many sensors. Each message of a further sensor is a scan by itself.
inline constexpr std::size_t kMaxSensors = 16;
/// A scan has at most this many points, those of a depth image of 1280 × 800; further messages begin a new one. One
/// step adds at least one scan, and further ones while they have no more points than this together.
inline constexpr std::size_t kMaxScanPoints = 1'024'000;

}  // namespace tern
