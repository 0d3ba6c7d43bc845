// The node of tern-detector: depth images and point clouds in, sightings out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/knobs.h"
#include "core/world/scan.h"
#include "core/world/voxel_map.h"
#include "detector/scan_parts.h"
#include "perception/detector.h"
#include "perception/frozen_check.h"
#include "runtime/bus.h"
#include "runtime/node.h"

namespace tern {

/// The section `detector:` of a scenario.
struct DetectorConfig {
  bool ground = true;
  double ground_z = 0.0;
  double least_range_m = 0.2;
  DepthNoise noise{.constant_m = 0.0, .per_m = 0.0025, .block = 1};      ///< of DEPTH_IMAGE
  DepthNoise cloud_noise{.constant_m = 0.02, .per_m = 0.0, .block = 1};  ///< of POINT_CLOUD

  template <typename V>
  void visit(V& v) {
    v("ground", ground, "there is a level ground: points on it are no obstacles");
    v("ground_z", ground_z, Range::within(1e6), "height of the ground, W, m");
    v("least_range_m", least_range_m, Range{0.0, 10.0}, "nearer depths are not used, as of the vehicle's own body, m");
    v("sigma_m", noise.constant_m, Range{0.0, 1.0},
      "noise of a DEPTH_IMAGE's depths: σ(z) = sigma_m + sigma_per_m · z², m");
    v("sigma_per_m", noise.per_m, Range{0.0, 1.0}, "the same, 1/m");
    v("noise_block", noise.block, Range{1, 32},
      "blocks of this many pixels have the same noise, as of a stereo camera");
    v("cloud_sigma_m", cloud_noise.constant_m, Range{0.0, 1.0},
      "noise of a POINT_CLOUD's distances: σ(z) = cloud_sigma_m + cloud_sigma_per_m · z², m");
    v("cloud_sigma_per_m", cloud_noise.per_m, Range{0.0, 1.0}, "the same, 1/m; 0.0025 for clouds of a stereo camera");
  }
};

/// Finds sightings in every DEPTH_IMAGE and POINT_CLOUD by perception/, and publishes them as OBSTACLE_SIGHTINGS of the
/// same sensor and time. Points on the ground and on the occupied voxels of SEMANTIC_MAP are no sightings. Voxels of
/// class "fence" are air, and do not count.
///
/// | input                                                       | effect                                            |
/// |-------------------------------------------------------------|---------------------------------------------------|
/// | an image without a measured depth, or with parts of another | not used; HEARTBEAT names sensor and reason       |
/// | the same depths from another place (FrozenCheck)            | not used; HEARTBEAT names the frozen sensor       |
/// | images faster than they are handled                         | the newest of each sensor is used, others counted |
/// | a message of too many sensors, or a measurement too large   | not used; HEARTBEAT says so (ScanParts)           |
/// | no scan for kSilence                                        | HEARTBEAT is WAITING                              |
///
/// An image that is not used makes the sensor silent for the predictor. A scan costs 1 to 4 ms of CPU time.
class DetectorNode final : public Node {
 public:
  /// Without a scan for this time, HEARTBEAT is WAITING.
  static constexpr Duration kSilence{2'000'000};
  /// A trouble is named for this long after it happened last.
  static constexpr Duration kTroubleShown{5'000'000};

  DetectorNode(Bus& bus, const DetectorConfig& config);

  [[nodiscard]] UTime next_wakeup() const override;
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;

 private:
  void on_map(const MapChunk& chunk);
  void refused(const char* channel);
  void detect(const ScanParts<DepthImage>::Whole& image);
  void detect(const ScanParts<CloudScan>::Whole& cloud);
  void publish(const Result<DepthPicture>& picture, UTime at, std::int32_t sensor);
  template <class M>
  [[nodiscard]] bool is_frozen(const std::vector<M>& parts);
  void note(std::string trouble);

  Bus& bus_;
  DetectorConfig config_;
  ScanParts<DepthImage> images_;
  ScanParts<CloudScan> clouds_;
  MapAssembler map_;
  std::vector<Box> occupied_;
  Detector detector_;
  FrozenCheck frozen_;
  std::optional<UTime> last_scan_, trouble_at_, left_out_at_;
  std::int64_t left_out_ = 0;
  std::string trouble_;
};

}  // namespace tern
