// A quadrotor that flies setpoints: body, controller, wind and estimator in steps of one millisecond.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "core/base/time.h"
#include "core/world/vehicle.h"
#include "simulator/vehicle/estimator.h"
#include "simulator/vehicle/flight_controller.h"
#include "simulator/vehicle/quadrotor.h"
#include "simulator/vehicle/wind.h"

namespace tern {

/// Step of body and controller.
inline constexpr Duration kVehicleStep{1'000};

/// The section `simulator.quadrotor`. The class sets the defaults of body and controller.
struct QuadrotorConfig {
  QuadrotorClass kind = QuadrotorClass::Camera;
  QuadrotorSpec body = quadrotor_spec(kind);
  FlightControllerSpec controller = controller_for(kind, body);

  /// The default gains, with feed-forward for the body's drag and its lag of tilting. A racer's limits of tilt and rate
  /// exceed those that are planned for one (70°, 900°/s).
  static FlightControllerSpec controller_for(QuadrotorClass kind, const QuadrotorSpec& body);
  template <typename V>
  void visit(V& v) {
    v("class", kind, KnobWords<QuadrotorClass>{{"camera", QuadrotorClass::Camera}, {"racer", QuadrotorClass::Racer}},
      "`camera`: 0.5 m, thrust/weight 2; `racer`: 0.25 m, thrust/weight 4; sets the defaults of the other keys");
    body = quadrotor_spec(kind);
    v("body", body);
    controller = controller_for(kind, body);
    v("controller", controller);
  }
};

/// The true state of one step.
struct VehicleTruth {
  UTime at;
  MotionSample motion;  ///< W; j is zero
  Eigen::Quaterniond q;
  Vec3 w = Vec3::Zero();
  bool on_ground = false;
};

/// The estimate of an estimator outside of the model: p̂ = p + position, v̂ = v + velocity, q̂ = attitude · q.
struct NavigationError {
  Vec3 position = Vec3::Zero();                                  ///< W, m
  Vec3 velocity = Vec3::Zero();                                  ///< W, m/s
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();  ///< in W, unit
};

/// A simulated quadrotor. It begins in hover at `start`, as after a long hover in the mean wind. If `start` lies on the
/// ground, it begins standing there.
///
/// Time advances in whole steps. The newest command holds until the next one: it is extrapolated with its acceleration
/// and jerk for at most kHeldFor, then the place is held. Without a command the model holds its start. Deterministic
/// from the seed and the commands. A step costs about a microsecond.
class QuadrotorModel {
 public:
  /// A command is extrapolated for at most this time.
  static constexpr Duration kHeldFor{100'000};

  QuadrotorModel(const QuadrotorConfig& config, const WindSpec& wind, const EstimatorSpec& estimator,
                 std::uint64_t seed, const Vec3& start, double ground_z, UTime now);

  /// Sets the newest setpoint; `at` is its time.
  void command(const UavState& setpoint) { command_ = setpoint; }
  /// Disarmed, the rotors have their least thrust: on the ground the vehicle stays there.
  void set_armed(bool armed) { armed_ = armed; }
  /// Held, the body stands still, as on its legs, whatever the wind; time and wind go on.
  void set_held(bool held) { held_ = held; }
  [[nodiscard]] bool is_held() const { return held_; }
  /// Makes all whole steps up to `now`.
  void advance(UTime now);

  [[nodiscard]] UTime time() const { return time_; }
  [[nodiscard]] VehicleTruth truth() const;
  /// The state that the controller uses: with the estimator's errors, without latency; yaw from q.
  [[nodiscard]] UavState estimate() const;
  /// The newest estimate with the latency applied. @return nullopt before the first one
  [[nodiscard]] std::optional<UavState> delayed_estimate();
  /// Changes the gains.
  void tune(const FlightControllerSpec& gains) { controller_.tune(gains); }
  /// Resets the estimator with a horizontal shift of this distance.
  void jump_estimate(double metres) { estimator_.jump(metres); }
  /// The same by a given shift, m.
  void jump_estimate(const Vec3& by) { estimator_.jump(by); }
  /// Sets the error of another estimator, which adds to this one's until the next call; nullopt: none.
  void set_estimate_error(const std::optional<NavigationError>& error) { other_error_ = error; }
  [[nodiscard]] int resets() const { return estimator_.jumps(); }
  [[nodiscard]] const QuadrotorState& state() const { return state_; }

 private:
  [[nodiscard]] FlightCommand commanded() const;
  [[nodiscard]] FlightEstimate believed() const;
  void step_once();
  void move_body(const Vec3& air);
  void trim_for_wind();

  QuadrotorConfig config_;
  Wind wind_;
  EstimateNoise estimator_;
  std::optional<NavigationError> other_error_;
  Duration latency_;
  FlightController controller_;
  QuadrotorState state_;
  double ground_z_;
  UTime time_;
  bool armed_ = true, held_ = false;
  std::optional<UavState> command_;
  UavState start_;  ///< at rest
  std::deque<UavState> delayed_;
};

}  // namespace tern
