// A visual-inertial estimator: a right-invariant stereo MSCKF with a start at rest, position fixes, and an odometry
// frame with bounded steps. docs/estimation.md derives the equations.
#pragma once

#include <memory>
#include <optional>

#include "core/world/inertial.h"
#include "estimator/config.h"
#include "estimator/estimate.h"
#include "estimator/masks.h"

namespace tern {

/// A frame or a fix that is farther ahead of the IMU's newest sample is refused: one of the clocks is wrong.
inline constexpr Duration kMaxAhead{500'000};
/// When no frames come, the filter follows the IMU this far behind. A frame may be this late.
inline constexpr Duration kMaxDelay{250'000};
/// Samples may be missing for this long in motion. A longer gap ends in EstimatorPhase::Lost. So do samples in a row
/// that span more than this and are all older than the newest one: the IMU's clock has stepped back.
inline constexpr Duration kMaxImuGap{500'000};

/// Rates (rad/s) and specific forces (m/s²) that a sample cannot exceed; 0: unknown.
struct ImuRange {
  double rate = 0.0;
  double force = 0.0;
};

/// Estimates pose, velocity and biases. A pure function of the sequence of its inputs: the same sequence gives the same
/// bits.
///
/// Inputs of each kind come in the order of their times. A frame or a fix may come before or after the IMU samples
/// around it: it waits until a sample reaches its time. Cost of a frame: some 1 ms with 150 tracks and 11 clones.
///
/// | input      | effect                                                                                   |
/// |------------|------------------------------------------------------------------------------------------|
/// | sample     | moves the estimate; at rest, improves biases and tilt                                     |
/// | frame      | a new clone of the pose; features whose track ended, or spans all clones, correct the state |
/// | fix        | corrects the state by the pose at its time                                               |
///
/// A correction of at most max_step and max_turn moves the pose in the odometry frame. A larger one changes T_WO and
/// its epoch, and leaves position and yaw in that frame as they are. Velocity, roll and pitch are corrected in both
/// cases.
class Estimator {
 public:
  /// @param rest  where the vehicle rests at the start
  explicit Estimator(const EstimatorConfig& config, const RestPlace& rest = {});
  ~Estimator();
  Estimator(const Estimator& other);
  Estimator(Estimator&& other) noexcept;
  Estimator& operator=(const Estimator& other) = delete;
  Estimator& operator=(Estimator&& other) noexcept;

  /// Begins with a known state instead of a rest. Forgets all earlier inputs. T_WO is the identity.
  void start(const StartState& state);

  InputOutcome add(const ImuSample& sample, const ImuRange& range = {});
  /// @param masks  features in these parts are not used
  InputOutcome add(const FeatureFrame& frame, const Masks& masks = {});
  InputOutcome add(const PositionFix& fix);

  /// Returns the estimate at the newest sample; nullopt while Waiting or Lost.
  [[nodiscard]] std::optional<Estimate> estimate() const;
  [[nodiscard]] const EstimatorStatus& status() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Returns the message for an estimate; its header is empty.
Odometry to_odometry(const Estimate& estimate);

}  // namespace tern
