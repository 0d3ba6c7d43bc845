#include "campaign/experiments/limits_check.h"

#include <fmt/format.h>

namespace tern {

std::string late_sensor(const SimulatorConfig& simulator, const PredictorConfig& predictor,
                        const PlannerConfig& planner) {
  const bool is_declared = simulator.declare && predictor.model != PredictorModel::Detections;
  if (is_declared || !simulator.sensor.present) return "";
  const double age_s = simulator.sensor.latency_s + 0.5 / simulator.sensor.rate_hz + 0.5 * predictor.period().seconds();
  if (age_s <= planner.stale_after_s) return "";
  return fmt::format(
      "the newest detection is {:.2f} s old on average (simulator.sensor: latency_s {:g}, rate_hz {:g}), and the "
      "planner answers STALE_WORLD beyond planner.stale_after_s, {:g} s: a faster sensor, or a larger stale_after_s",
      age_s, simulator.sensor.latency_s, simulator.sensor.rate_hz, planner.stale_after_s);
}

std::vector<std::string> excess_thrust(const Limits& limits, const SimulatorConfig& simulator) {
  if (!simulator.quadrotor) return {};
  const double ratio = simulator.quadrotor->quadrotor.body.thrust_to_weight;
  const double most = ratio * kGravity;
  const std::string has = fmt::format("the vehicle has {:.3g} m/s² (thrust_to_weight {:g})", most, ratio);
  if (limits.dynamics) {
    if (limits.dynamics->thrust_max <= most) return {};
    return {fmt::format("uav.dynamics.thrust_max is {:g} m/s², and {}: plans may ask for more than it can give",
                        limits.dynamics->thrust_max, has)};
  }
  const double asked = (limits.a_max + kGravity * Vec3::UnitZ()).norm();
  if (asked <= most) return {};
  return {
      fmt::format("uav.limits.a_max [{:g}, {:g}, {:g}] takes a thrust of up to {:.3g} m/s², and {}: give "
                  "uav.dynamics, or a smaller a_max",
                  limits.a_max.x(), limits.a_max.y(), limits.a_max.z(), asked, has)};
}

}  // namespace tern
