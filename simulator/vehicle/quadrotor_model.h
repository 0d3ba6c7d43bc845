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

/// Body and controller step at 1 kHz.
inline constexpr Duration kVehicleStep{1'000};

/// The section `simulator.quadrotor`. The class chooses the defaults of what follows it.
struct QuadrotorConfig {
  QuadrotorClass kind = QuadrotorClass::Camera;
  QuadrotorSpec body = quadrotor_spec(kind);
  FlightControllerSpec controller = controller_for(kind, body);

  /// The default gains, with the body's own drag and tilting lag fed forward; a racer tilts and turns beyond what is
  /// planned for one (70°, 900°/s).
  static FlightControllerSpec controller_for(QuadrotorClass kind, const QuadrotorSpec& body);
  template <typename V>
  void visit(V& v) {
    v("class", kind, KnobWords<QuadrotorClass>{{"camera", QuadrotorClass::Camera}, {"racer", QuadrotorClass::Racer}},
      "`camera`: 0.5 m, thrust/weight 2; `racer`: 0.25 m, thrust/weight 4; defaults of all other keys");
    body = quadrotor_spec(kind);
    v("body", body);
    controller = controller_for(kind, body);
    v("controller", controller);
  }
};

/// The truth of one step, for whoever judges or shows it.
struct VehicleTruth {
  UTime at;
  MotionSample motion;  ///< W; j is zero
  Eigen::Quaterniond q;
  Vec3 w = Vec3::Zero();
  bool on_ground = false;
};

/// Begins in hover at `start`, as after hovering in the mean wind for long, or standing there if that is the ground.
/// Time moves by advance() in whole steps since `now`. Between two calls the newest command holds: its motion is
/// carried on by its acceleration and jerk, at most for kHeldFor, then at rest where that ended. Without any command it
/// keeps its start. Deterministic from the seed and the commands. A step costs about a microsecond.
class QuadrotorModel {
 public:
  /// A command is carried on no longer than this: then it holds that place.
  static constexpr Duration kHeldFor{100'000};

  QuadrotorModel(const QuadrotorConfig& config, const WindSpec& wind, const EstimatorSpec& estimator,
                 std::uint64_t seed, const Vec3& start, double ground_z, UTime now);

  /// The newest setpoint; `at` is its time.
  void command(const UavState& setpoint) { command_ = setpoint; }
  /// Rotors at their least thrust until armed again; on the ground it stays there.
  void set_armed(bool armed) { armed_ = armed; }
  /// All whole steps up to `now`.
  void advance(UTime now);

  [[nodiscard]] UTime time() const { return time_; }
  [[nodiscard]] VehicleTruth truth() const;
  /// What the controller takes for the truth, now: the estimator's errors, no latency. yaw from q.
  [[nodiscard]] UavState estimate() const;
  /// The newest estimate that has been said by now: of latency_s ago. @return nullopt before the first
  [[nodiscard]] std::optional<UavState> delayed_estimate();
  /// Other gains from now on.
  void tune(const FlightControllerSpec& gains) { controller_.tune(gains); }
  /// The estimator resets itself by so many metres.
  void jump_estimate(double metres) { estimator_.jump(metres); }
  [[nodiscard]] int resets() const { return estimator_.jumps(); }
  [[nodiscard]] const QuadrotorState& state() const { return state_; }

 private:
  [[nodiscard]] FlightCommand commanded() const;
  [[nodiscard]] FlightEstimate believed() const;
  void step_once();
  void trim_for_wind();

  QuadrotorConfig config_;
  Wind wind_;
  Estimator estimator_;
  Duration latency_;
  FlightController controller_;
  QuadrotorState state_;
  double ground_z_;
  UTime time_;
  bool armed_ = true;
  std::optional<UavState> command_;
  UavState start_;  // at rest there
  std::deque<UavState> delayed_;
};

}  // namespace tern
