// The start: whether the IMU is at rest, and the state that follows from its mean there.
#pragma once

#include <deque>
#include <utility>

#include "core/base/time.h"
#include "estimator/config.h"
#include "estimator/filter/motion.h"

namespace tern {

/// Means of an IMU at rest.
struct RestMean {
  Vec3 rate = Vec3::Zero();   ///< rad/s
  Vec3 force = Vec3::Zero();  ///< m/s²
  double duration = 0.0;      ///< s
};

/// Watches an IMU for rest. Means of blocks of 0.1 s are compared with the mean since the rest began. A block ends the
/// rest if it differs by more than 5 standard deviations of its noise on any axis. The newest kYoungBlocks blocks
/// are not part of the mean, because a slow motion may have begun in them.
///
/// Constant velocity looks like rest: the caller must know that the vehicle stands.
class RestMeter {
 public:
  RestMeter(const ImuNoise& noise, double gravity) : noise_(noise), gravity_(gravity) {}

  /// @param end  of the step
  /// @return false if this step ends the rest; the meter then begins anew unless the caller stops
  bool add(const ImuStep& step, UTime end);
  /// The mean over at most the last kRestMemory.
  [[nodiscard]] RestMean mean() const;
  /// When the mean ends; later samples may belong to a motion. @pre mean().duration > 0
  [[nodiscard]] UTime end() const { return end_; }
  /// Forgets everything.
  void restart();

 private:
  struct Block {
    Vec3 rate = Vec3::Zero(), force = Vec3::Zero();  // integrals
    double duration = 0.0;
    UTime end;
    void add(const Block& other);
  };
  [[nodiscard]] bool is_still(const Block& block) const;

  ImuNoise noise_;
  double gravity_;
  Block rest_, current_;
  std::deque<Block> young_;
  UTime end_;
};
inline constexpr int kYoungBlocks = 4;
inline constexpr double kBlock = 0.1, kRestMemory = 10.0;  ///< s

/// Returns the state at rest, and the covariance of its right-invariant error.
///
/// The mean specific force f points up: R̂ is the smallest turn, after the yaw, that turns f there. An unknown
/// horizontal accelerometer bias b tilts it by θ_x = −b_y/g, θ_y = b_x/g: tilt and bias are fully correlated. The
/// vertical bias is measured as |f| − g.
std::pair<NavState, NavMatrix> state_at_rest(const RestMean& mean, const EstimatorConfig& config,
                                             const RestPlace& place);

/// Returns the given state, and the covariance of its right-invariant error: e_p = δp + [p̂]× θ, e_v = δv + [v̂]× θ.
std::pair<NavState, NavMatrix> known_state(const StartState& start);

}  // namespace tern
