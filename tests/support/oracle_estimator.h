// An estimator for tests: it knows the truth, and is as wrong as the test wants.
#pragma once

#include <functional>
#include <optional>

#include "core/world/inertial.h"
#include "messages/codec.h"
#include "runtime/bus.h"
#include "runtime/node.h"
#include "simulator/inertial/strapdown.h"

namespace tern::testing {

/// Errors that an OracleEstimator adds to the truth. The test may change them in flight.
struct OracleErrors {
  Vec3 drift = Vec3::Zero();   ///< m, of the position in O
  Vec3 offset = Vec3::Zero();  ///< m, of T_WO
  double sigma = 0.0;          ///< stated standard deviation of the position per axis, m
  bool is_silent = false;      ///< publishes nothing
};

/// Publishes ODOMETRY at every fourth IMU batch. It integrates an IMU without noise from a known start.
class OracleEstimator final : public Node {
 public:
  OracleEstimator(Bus& bus, const Vec3& start, const OracleErrors& errors) : bus_(bus), errors_(errors) {
    state_.p = start;
    bus.subscribe(channels::kImu, [this](const ImuBatch& batch) { on_imu(batch); });
  }
  [[nodiscard]] UTime next_wakeup() const override { return kNever; }
  void step(UTime /*now*/) override {}
  [[nodiscard]] NodeHealth health() const override {
    return {at_ ? ProcessState::Ready : ProcessState::Waiting, at_ ? "" : "IMU"};
  }

 private:
  void on_imu(const ImuBatch& batch) {
    for (const ImuSample& sample : batch.samples) {
      const double h = at_ ? (sample.at - *at_).seconds() : 5e-3;
      state_ = strapdown(state_, {sample.angular_velocity, sample.specific_force}, h);
      at_ = sample.at;
    }
    if (++batches_ % 4 == 0 && !errors_.is_silent) bus_.publish(channels::kOdometry, odometry());
  }
  [[nodiscard]] Odometry odometry() const {
    Odometry odometry;
    odometry.at = *at_;
    odometry.state = EstimatorState::Tracking;
    odometry.p_OB = state_.p + errors_.drift - errors_.offset;
    odometry.v_OB = state_.v;
    odometry.p_WO = errors_.offset;
    const Eigen::Quaterniond q(state_.R);
    odometry.q_OB = {q.w(), q.x(), q.y(), q.z()};
    for (const int k : {0, 7, 14}) odometry.pose_covariance[idx(k)] = errors_.sigma * errors_.sigma;
    return odometry;
  }

  Bus& bus_;
  const OracleErrors& errors_;
  InertialState state_;
  std::optional<UTime> at_;
  int batches_ = 0;
};

}  // namespace tern::testing
