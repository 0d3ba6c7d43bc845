// An autopilot behind MAVLink: the simulator's quadrotor, with what was measured of PX4's manners.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "mavlink/messages.h"
#include "simulator/vehicle/quadrotor_model.h"

namespace tern::mavlink {

/// The section `autopilot_sim`. Of `quadrotor.controller` velocity_d, tilt_max, rate_max, speed_max, drag_per_s and
/// lead_s do not count: an autopilot has the first four from its parameters, and leaves the others to the bridge.
struct SimulatedAutopilotConfig {
  double clock_rate = 0.99;
  double velocity_d = 0.2;
  Duration answer_after{100'000};
  Duration busy_for{2'000'000};
  QuadrotorConfig quadrotor;  ///< this and the next two are those of the section `simulator`
  WindSpec wind;
  EstimatorSpec estimator;

  template <typename V>
  void visit(V& v) {
    v("clock_rate", clock_rate, Range{0.9, 1.1}, "seconds of its clock per second");
    v("answer_after_s", answer_after, Range{0.0, 2.0}, "acknowledgements come this late, s");
    v("busy_s", busy_for, Range{0.0, 60.0}, "so long after its start it rejects commands for the moment, s");
    v("velocity_d", velocity_d, Range{0.0, 2.0}, "MPC_XY_VEL_D_ACC: acceleration against all of its own, share");
  }
};

/// It stands on the ground at the origin of its local frame until it is armed. Pure: frames and times in, frames out.
///
/// As PX4 does: HEARTBEAT 1 Hz, SYS_STATUS and EXTENDED_SYS_STATE 5 Hz, LOCAL_POSITION_NED and ODOMETRY 30 Hz,
/// ATTITUDE_QUATERNION 50 Hz, TIMESYNC 10 Hz, other rates by SET_MESSAGE_INTERVAL. OFFBOARD is taken only while
/// setpoints have come for half a second, and is left COM_OF_LOSS_T after the last one for what COM_OBL_RC_ACT says.
/// HIL_STATE_QUATERNION states no time. Setpoints are held, not carried on. Any system may command it. The velocity
/// loop has a D term, MPC_XY_VEL_D_ACC, which opposes the whole acceleration. It disarms when it has landed.
///
/// Parameters beside PX4's: SIM_ARM_REFUSE (it refuses to arm), SIM_BAT_PCT (what is left, %), SIM_EST_JUMP (writing it
/// shifts the estimate by so many metres).
class SimulatedAutopilot {
 public:
  SimulatedAutopilot(const SimulatedAutopilotConfig& config, std::uint64_t seed, UTime now);

  void hear(const Frame& frame, UTime now);
  void step(UTime now);
  std::vector<Frame> take_frames() { return std::exchange(out_, {}); }
  [[nodiscard]] const QuadrotorModel& model() const { return model_; }
  [[nodiscard]] bool armed() const { return armed_; }
  [[nodiscard]] std::string mode() const;

 private:
  enum class Mode : std::uint8_t { Position, Loiter, Land, Offboard };
  struct Stream {
    Duration period;
    UTime next;
  };
  struct Answer {
    UTime due;
    CommandAck ack;
  };
  void hear_command(const CommandLong& command, Address from, UTime now);
  [[nodiscard]] std::uint8_t obey(const CommandLong& command, UTime now);
  [[nodiscard]] std::uint8_t set_mode(int main, int sub, UTime now);
  void enter(Mode mode);
  void hear_target(const SetPositionTargetLocalNed& target, UTime now);
  void set_parameter(const std::string& name, double value);
  void tune();
  void say_parameter(const std::string& name);
  void watch_offboard(UTime now);
  void fly(UTime now);
  void say_streams(UTime now);
  void say_stream(std::uint32_t id, UTime now);
  void say_odometry();
  void say_truth();
  void complain(const std::string& words);
  [[nodiscard]] std::uint64_t clock_us(UTime now) const;
  [[nodiscard]] bool has_stream(UTime now) const;
  [[nodiscard]] std::uint32_t custom_mode() const;
  template <class M>
  void say(const M& message);

  SimulatedAutopilotConfig config_;
  QuadrotorModel model_;
  UTime started_;
  bool armed_ = false;
  Mode mode_ = Mode::Position;
  UavState command_;
  UavState target_;  ///< the newest setpoint, local ENU
  std::optional<UTime> streaming_since_, last_target_, landed_since_;
  UTime last_step_;
  double battery_ = 0.9;
  std::map<std::string, double> parameters_;
  std::map<std::uint32_t, Stream> streams_;
  std::deque<Answer> answers_;
  std::uint8_t sequence_ = 0;
  std::vector<Frame> out_;
};

}  // namespace tern::mavlink
