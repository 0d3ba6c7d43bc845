// A bridge and a simulated autopilot on virtual time, over a link that may lose, duplicate, delay and cut frames.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <vector>

#include "core/base/random.h"
#include "mavlink/axes.h"
#include "mavlink/bridge.h"
#include "mavlink/sim/simulated_autopilot.h"

namespace tern::mavlink {

struct LinkFaults {
  double lost = 0.0, doubled = 0.0;
  Duration delay_from{1'000}, delay_to{1'000};  ///< a later frame may overtake
};

/// Along x from the start, 2 m/s after a second.
inline MotionSample along(double t) {
  constexpr double kSpeed = 2.0;
  MotionSample m{Vec3(0, 0, 2), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  m.p.x() = t < 1.0 ? 0.5 * kSpeed * t * t : kSpeed * (t - 0.5);
  m.v.x() = kSpeed * std::min(t, 1.0);
  m.a.x() = t < 1.0 ? kSpeed : 0.0;
  return m;
}

class FlightInMemory {
 public:
  explicit FlightInMemory(const BridgeConfig& bridge_config = {.start = Start::Arm, .set_parameters = true},
                          const SimulatedAutopilotConfig& autopilot_config = {}, std::uint64_t seed = 1)
      : config(bridge_config), rng(seed), bridge(bridge_config, uav(), now), autopilot(autopilot_config, seed, now) {
    // An ArduPilot whose owner allows the tilt and the jerk of uav().
    for (const auto& [name, value] : {std::pair{"ATC_ANGLE_MAX", 45.0F}, {"ATC_ACC_R_MAX", 0.0F}, {"WP_ACC_Z", 3.0F}}) {
      set_parameter(name, value);
    }
    autopilot.take_frames();
  }

  static UavSpec uav() {
    UavSpec spec;
    spec.start = Vec3(0, 0, 2);
    spec.limits.v_max.z() = 1.5;
    spec.limits.dynamics.emplace();  // PX4's default limits
    return spec;
  }

  /// A stub of the executor: at rest at the vehicle's place until it follows, then `path` of the time since.
  void say_setpoint() {
    const VehicleStatus status = bridge.status(now);
    if (!status.following) follows_since.reset();
    if (status.following && !follows_since && path) follows_since = now;
    UavState setpoint;
    setpoint.at = now;
    const auto state = bridge.state();
    if (follows_since) {
      setpoint.motion = path((now - *follows_since).seconds());
      last = setpoint.motion;
    } else if (!status.following && state) {
      setpoint.motion.p = state->motion.p;
      last = setpoint.motion;
    } else {
      setpoint.motion.p = last.p;
    }
    if (state && speaks) bridge.receive(setpoint);
  }

  void run(double seconds) {
    const UTime end = now + Duration::from_seconds(seconds);
    for (; now < end; now = now + Duration{2'000}) {
      deliver();
      if (ground_station_there && beats % 500 == 0)
        autopilot.receive(to_frame(Heartbeat{.type = 6}, {255, 190}, 0), now, false);
      if (beats++ % 5 == 0) say_setpoint();
      if (bridge_runs) bridge.step(now);
      autopilot.step(now);
      for (const Frame& f : bridge.take_frames()) {
        if (sent) sent(f);
        post(f, false);
      }
      for (const Frame& f : autopilot.take_frames()) {
        if (!hides || !hides(f)) post(shifted(f), true);
      }
      for (std::string& word : bridge.take_log_lines()) words.push_back(std::move(word));
      if (each) each();
    }
  }
  bool run_until(const std::function<bool()>& condition, double patience_s = 60.0) {
    const UTime end = now + Duration::from_seconds(patience_s);
    while (!condition() && now < end) run(0.05);
    return condition();
  }
  bool following() const { return bridge.status(now).following; }

  /// Sends a command as a ground station: any system may command.
  void ground_station(CommandLong command) {
    command.target_system = 1;
    autopilot.receive(to_frame(command, {255, 190}, 0), now, false);
  }
  void set_parameter(const std::string& name, float value) {
    autopilot.receive(
        to_frame(ParamSet{.param_value = value, .target_system = 1, .param_id = text_of<16>(name), .param_type = 9},
                 {255, 190}, 0),
        now);
  }
  /// The value in the autopilot, as another ground station reads it. Its other frames of this moment are lost.
  float parameter(const std::string& name) {
    autopilot.take_frames();
    autopilot.receive(to_frame(ParamRequestRead{.target_system = 1, .param_id = text_of<16>(name)}, {255, 190}, 0),
                      now);
    for (const Frame& frame : autopilot.take_frames()) {
      const auto value = from_frame<ParamValue>(frame);
      if (value && string_of(value->param_id) == name) {
        return value->param_type == 6 ? static_cast<float>(std::bit_cast<std::int32_t>(value->param_value))
                                      : value->param_value;
      }
    }
    throw std::runtime_error("no parameter " + name);
  }

  BridgeConfig config;
  UTime now{1'000'000'000};
  Rng rng;
  Bridge bridge;
  SimulatedAutopilot autopilot;
  LinkFaults faults;
  bool cut = false, bridge_runs = true, speaks = true, ground_station_there = true;
  std::function<MotionSample(double)> path;
  std::function<void()> each;
  std::function<bool(const Frame&)> hides;  ///< frames of the autopilot that the bridge does not get
  Vec3 shifts = Vec3::Zero();               ///< added to the estimate that the bridge gets, ENU, m
  std::function<void(const Frame&)> sent;   ///< called with each frame of the bridge
  std::optional<UTime> follows_since;
  std::vector<std::string> words;

 private:
  [[nodiscard]] Frame shifted(const Frame& frame) const {
    const auto moved = [&](auto message) {
      message.p = ned_of(enu_of(message.p) + shifts);
      return to_frame(message, frame.from, frame.sequence);
    };
    if (const auto m = from_frame<Odometry>(frame)) return moved(*m);
    if (const auto m = from_frame<LocalPositionNed>(frame)) return moved(*m);
    return frame;
  }
  void post(const Frame& frame, bool to_bridge) {
    if (cut || (!to_bridge && !bridge_runs)) return;
    const int copies = rng.uniform() < faults.lost ? 0 : rng.uniform() < faults.doubled ? 2 : 1;
    for (int k = 0; k < copies; ++k) {
      const double delay =
          rng.uniform(static_cast<double>(faults.delay_from.us), static_cast<double>(faults.delay_to.us) + 1);
      flying.emplace(now + Duration{static_cast<std::int64_t>(delay)}, std::pair(to_bridge, frame));
    }
  }
  void deliver() {
    while (!flying.empty() && flying.begin()->first <= now) {
      const auto [to_bridge, frame] = flying.begin()->second;
      if (to_bridge) {
        if (bridge_runs) bridge.receive(frame, now);
      } else {
        autopilot.receive(frame, now);
      }
      flying.erase(flying.begin());
    }
  }
  std::multimap<UTime, std::pair<bool, Frame>> flying;
  MotionSample last;
  int beats = 0;
};

}  // namespace tern::mavlink
