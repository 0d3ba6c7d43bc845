// The node of tern-estimator: IMU, feature tracks and fixes in, odometry out.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/world/inertial.h"
#include "core/world/track.h"
#include "estimator/estimator.h"
#include "runtime/batches.h"
#include "runtime/bus.h"
#include "runtime/node.h"

namespace tern {

/// The section `estimator:` of a scenario.
struct EstimatorNodeConfig {
  EstimatorConfig filter;
  int imu = 0;             ///< sensor_id of the IMU
  int camera = 0;          ///< sensor_id of the stereo pair
  double start_yaw = 0.0;  ///< rad
  bool mask_movers = true;

  template <typename V>
  void visit(V& v) {
    v("imu", imu, Range{0, 2'147'483'647}, "`sensor_id` of the IMU that is used");
    v("camera", camera, Range{0, 2'147'483'647}, "`sensor_id` of the stereo pair that is used");
    v("start_yaw", start_yaw, Range::within(3.2), "yaw of the vehicle at rest at the start, rad");
    v("mask_movers", mask_movers,
      "features that may lie on a predicted mover are not used; static tracks hide nothing");
    filter.visit(v);
  }
};

/// ODOMETRY is sent for each frame; without frames, once per this time.
inline constexpr Duration kOdometryPeriod{50'000};
/// An input is silent after this time, and a trouble is reported for kTroubleShown after it happened last.
inline constexpr Duration kEstimatorInputSilent{300'000}, kTroubleShown{5'000'000};
/// Movers of predictions that are older are not masked: their boxes would hide everything.
inline constexpr Duration kOldestMask{1'000'000};

/// Estimates from messages. The published bytes depend on the messages and their order alone, and never on the clock.
/// So a recorded flight gives the same bytes again.
///
/// The vehicle rests at the scenario's start. Only the configured IMU and stereo pair are used; messages of others are
/// counted as late. HEARTBEAT is WAITING while there is no estimate or an input is silent, and names the newest
/// troubles.
class EstimatorNode final : public Node {
 public:
  /// @param start  the body at rest, W, m
  EstimatorNode(Bus& bus, const EstimatorNodeConfig& config, const Vec3& start);

  [[nodiscard]] UTime next_wakeup() const override { return kNever; }
  void step(UTime /*now*/) override {}
  [[nodiscard]] NodeHealth health() const override;

 private:
  void on_imu(const ImuBatch& batch);
  void on_frame(const FeatureFrame& frame);
  void on_fix(const PositionFix& fix);
  void on_predictions(const TrackSet& batch);
  [[nodiscard]] Masks masks_at(UTime at) const;
  void publish(UTime at);
  /// "IMU (sensor 0)" and so on, of the inputs that are silent.
  [[nodiscard]] std::string silent(UTime now) const;
  [[nodiscard]] std::string troubles() const;

  Bus& bus_;
  EstimatorNodeConfig config_;
  Estimator estimator_;
  BatchCollector<TrackSet> collector_;
  std::vector<Track> movers_;  // of the newest predictions
  UTime movers_made_at_;
  std::optional<UTime> newest_sample_;  // its time, and by the clock when it came
  std::optional<UTime> imu_came_, frame_came_;
  std::optional<UTime> published_;  // the IMU's time of the newest ODOMETRY
};

}  // namespace tern
