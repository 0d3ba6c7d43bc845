// A whole flight on virtual time whose vehicle is the simulated autopilot behind the bridge.
#pragma once

#include <algorithm>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "campaign/virtual_system.h"
#include "executor/app/executor_node.h"
#include "mavlink/app/mavlink_node.h"
#include "mavlink/sim/app/autopilot_sim_node.h"
#include "messages/channels.h"
#include "simulator/app/simulator_node.h"

namespace tern::mavlink {

/// One end of a cable in memory.
class CableEnd final : public Link {
 public:
  using Queue = std::shared_ptr<std::deque<Bytes>>;
  CableEnd(Queue in, Queue out) : in_(std::move(in)), out_(std::move(out)) {}
  std::optional<Portion> receive(UTime) override {
    if (in_->empty()) return std::nullopt;
    Portion portion{std::move(in_->front()), std::nullopt};
    in_->pop_front();
    return portion;
  }
  void send(std::span<const std::uint8_t> bytes) override { out_->emplace_back(bytes.begin(), bytes.end()); }
  [[nodiscard]] bool datagrams() const override { return true; }

 private:
  Queue in_, out_;
};

/// Outcome and errors of a flight.
struct FlownBehindMavlink {
  std::optional<FlightResult> result;
  double widest_tube = 0.0;                ///< m, of any request and axis
  double largest_error = 0.0, rmse = 0.0;  ///< m, of the estimate from the setpoint while following
  std::int64_t tube_exits = 0;
  double begun_at_height = 0.0;  ///< estimated, m, when the vehicle first followed
  bool landed = false;
  std::string why_not;  ///< the newest reason not to follow
};

/// Flies a scenario with these overrides to its end, then lands.
inline FlownBehindMavlink fly_behind_mavlink(const std::string& scenario_file, std::vector<std::string> overrides,
                                             BridgeConfig bridge_config,
                                             const SimulatedAutopilotConfig& autopilot_config) {
  const std::vector<std::string> behind{
      "simulator.vehicle=external", "simulator.wait_s=180",
      "simulator.wait_for=tern-mavlink, tern-executor, tern-predictor, tern-mapper, tern-planner"};
  overrides.insert(overrides.begin(), behind.begin(), behind.end());
  VirtualSystem system(scenario_file, overrides);
  VirtualRunner& runner = system.runner();
  bridge_config.start = Start::Arm;
  const auto down = std::make_shared<std::deque<Bytes>>(), up = std::make_shared<std::deque<Bytes>>();
  runner.start("tern-mavlink", [&](Bus& bus) {
    return std::make_unique<MavlinkNode>(bus, std::make_unique<CableEnd>(down, up), system.scenario().uav,
                                         bridge_config, std::nullopt);
  });
  runner.start("tern-autopilot-sim", [&](Bus& bus) {
    return std::make_unique<AutopilotSimNode>(bus, std::make_unique<CableEnd>(up, down), autopilot_config,
                                              system.scenario().seed);
  });
  FlownBehindMavlink flown;
  Bus& bus = runner.observer();
  VehicleStatus status;
  UavState setpoint, state;
  double squares = 0.0;
  std::int64_t n = 0;
  bus.subscribe(channels::kHorizonRequest, [&](const HorizonRequest& request) {
    flown.widest_tube = std::max(flown.widest_tube, request.tube.maxCoeff());
  });
  bus.subscribe(channels::kVehicleStatus, [&](const VehicleStatus& newest) {
    if (newest.following && flown.begun_at_height == 0.0) flown.begun_at_height = state.motion.p.z();
    status = newest;
    if (!newest.following) flown.why_not = newest.why_not;
  });
  bus.subscribe(channels::kSetpoint, [&](const UavState& newest) { setpoint = newest; });
  bus.subscribe(channels::kUavState, [&](const UavState& newest) {
    state = newest;
    if (!status.following || setpoint.at == UTime{}) return;
    const double later = (newest.at - setpoint.at).seconds();
    const MotionSample& m = setpoint.motion;
    const double error = (m.p + later * (m.v + 0.5 * later * m.a) - newest.motion.p).norm();
    flown.largest_error = std::max(flown.largest_error, error);
    squares += error * error;
    ++n;
  });
  runner.run(runner.now() + Duration{600'000'000}, [&] { return system.simulator().result().has_value(); });
  flown.result = system.simulator().result();
  flown.rmse = std::sqrt(squares / static_cast<double>(std::max<std::int64_t>(n, 1)));
  flown.tube_exits = system.executor().tube_exits();
  runner.stop("tern-simulator");  // a finished node ends every run()
  runner.run(runner.now() + Duration{60'000'000}, [&] { return status.landed && !status.armed; });
  flown.landed = status.landed && !status.armed;
  runner.run(runner.now() + Duration{2'000'000});  // the bridge sets parameters back
  return flown;
}

}  // namespace tern::mavlink
