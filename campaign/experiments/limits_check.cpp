#include "campaign/experiments/limits_check.h"

#include <fmt/format.h>

#include <optional>
#include <variant>

namespace tern {
namespace {

/// Rate and latency of a sensor.
struct Timing {
  double rate_hz, latency_s;
  [[nodiscard]] double age_s() const { return latency_s + 0.5 / rate_hz; }
};

/// The timing of the sensor whose newest frame is freshest; nullopt without sensors.
std::optional<Timing> freshest(const SimulatorConfig& simulator) {
  std::optional<Timing> best;
  const auto consider = [&](const auto& sensor) {
    const Timing timing{sensor.rate_hz, sensor.latency_s};
    if (!best || timing.age_s() < best->age_s()) best = timing;
  };
  if (simulator.sensor.present) consider(simulator.sensor);
  for (const auto& sensor : simulator.sensors) std::visit(consider, sensor);
  return best;
}

}  // namespace

std::string late_sensor(const SimulatorConfig& simulator, const PredictorConfig& predictor,
                        const PlannerConfig& planner) {
  const bool is_declared = simulator.declare && predictor.model != PredictorModel::Detections;
  const std::optional<Timing> sensor = freshest(simulator);
  if (is_declared || !sensor) return "";
  const double age_s = sensor->age_s() + 0.5 * predictor.period().seconds();
  if (age_s <= planner.stale_after_s) return "";
  return fmt::format(
      "the newest detection is {:.2f} s old on average (simulator.{}: latency_s {:g}, rate_hz {:g}), and the "
      "planner answers STALE_WORLD beyond planner.stale_after_s, {:g} s: a faster sensor, or a larger stale_after_s",
      age_s, simulator.sensors.empty() ? "sensor" : "sensors", sensor->latency_s, sensor->rate_hz,
      planner.stale_after_s);
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
