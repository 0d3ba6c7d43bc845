#include "estimator/app/estimator_node.h"

#include <fmt/format.h>

#include <utility>

#include "messages/batching.h"
#include "messages/channels.h"
#include "messages/codec.h"

namespace tern {

EstimatorNode::EstimatorNode(Bus& bus, const EstimatorNodeConfig& config, const Vec3& start)
    : bus_(bus), config_(config), estimator_(config.filter, RestPlace{PointInW{start}, config.start_yaw}) {
  bus_.subscribe(channels::kImu, [this](const ImuBatch& batch) { on_imu(batch); });
  bus_.subscribe(channels::kFeatureTracks, [this](const FeatureFrame& frame) { on_frame(frame); });
  bus_.subscribe(channels::kPositionFix, [this](const PositionFix& fix) { on_fix(fix); });
  if (config_.mask_movers) {
    bus_.subscribe(channels::kPredictions, [this](const TrackSet& batch) { on_predictions(batch); });
  }
}

void EstimatorNode::on_imu(const ImuBatch& batch) {
  if (batch.sensor_id != config_.imu) return bus_.count_late(channels::kImu);
  imu_came_ = bus_.clock().now();
  for (const ImuSample& sample : batch.samples) {
    estimator_.add(sample, {batch.saturation_rate, batch.saturation_force});
  }
  newest_sample_ = batch.samples.back().at;
  if (!published_ || *newest_sample_ - *published_ >= kOdometryPeriod) publish(*newest_sample_);
}

void EstimatorNode::on_frame(const FeatureFrame& frame) {
  if (frame.sensor_id != config_.camera) return bus_.count_late(channels::kFeatureTracks);
  frame_came_ = bus_.clock().now();
  const bool used = estimator_.add(frame, masks_at(frame.at)) == InputOutcome::Used;
  if (!used) bus_.count_late(channels::kFeatureTracks);
  if (newest_sample_ && used) publish(*newest_sample_);
}

void EstimatorNode::on_fix(const PositionFix& fix) {
  if (estimator_.add(fix) == InputOutcome::Refused) bus_.count_late(channels::kPositionFix);
}

void EstimatorNode::on_predictions(const TrackSet& batch) {
  auto batches = collector_.add(batch);
  if (!batches) return;
  TrackSet set = join_batches(std::move(*batches));
  std::erase_if(set.tracks, [](const Track& track) { return track.kind == TrackKind::Static; });
  movers_ = std::move(set.tracks);
  movers_made_at_ = set.made_at;
}

Masks EstimatorNode::masks_at(UTime at) const {
  Masks masks;
  if (at - movers_made_at_ > kOldestMask) return masks;
  for (const Track& track : movers_) masks.boxes_W.push_back(track.bounds(at, at));
  return masks;
}

void EstimatorNode::publish(UTime at) {
  published_ = at;
  Odometry odometry;
  if (const auto estimate = estimator_.estimate()) {
    odometry = to_odometry(*estimate);
  } else {
    odometry.at = at;
    const bool lost = estimator_.status().phase == EstimatorPhase::Lost;
    odometry.state = lost ? EstimatorState::Lost : EstimatorState::Starting;
  }
  bus_.publish(channels::kOdometry, odometry);
}

std::string EstimatorNode::silent(UTime now) const {
  std::string text;
  const auto look = [&](const char* input, std::int64_t sensor, const std::optional<UTime>& came) {
    if (came && now - *came <= kEstimatorInputSilent) return;
    const std::string since = came ? fmt::format("silent for {:.1f} s", (now - *came).seconds()) : "none came";
    text += fmt::format("{}{} of sensor {} ({})", text.empty() ? "" : ", ", input, sensor, since);
  };
  look("IMU", config_.imu, imu_came_);
  look("FEATURE_TRACKS", config_.camera, frame_came_);
  return text;
}

std::string EstimatorNode::troubles() const {
  std::string text;
  const EstimatorStatus& status = estimator_.status();
  for (int k = 0; k < kTroubles; ++k) {
    const std::int64_t count = status.count[idx(k)];
    if (count == 0 || !newest_sample_ || *newest_sample_ - status.last[idx(k)] > kTroubleShown) continue;
    text += fmt::format("{}{} ({} so far)", text.empty() ? "" : "; ", to_text(static_cast<Trouble>(k)), count);
    if (text.size() > 600) break;  // a heartbeat's text is bounded
  }
  return text;
}

NodeHealth EstimatorNode::health() const {
  std::string text = silent(bus_.clock().now());
  const EstimatorPhase phase = estimator_.status().phase;
  if (text.empty() && phase == EstimatorPhase::Waiting) text = "a vehicle at rest";
  if (phase == EstimatorPhase::Lost) {
    text = "a new start: the estimate is lost. Carry the vehicle to uav.start, and restart tern-estimator at rest";
  }
  const ProcessState state = text.empty() ? ProcessState::Ready : ProcessState::Waiting;
  const std::string more = troubles();
  if (!text.empty() && !more.empty()) text += "; ";
  return {state, text + more};
}

}  // namespace tern
