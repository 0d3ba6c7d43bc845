// An autopilot behind MAVLink: the simulator's quadrotor, with what was measured of PX4's manners.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "mavlink/messages.h"
#include "simulator/vehicle/quadrotor_model.h"

namespace tern::mavlink {

enum class Manners : std::uint8_t { Px4, ArduPilot };

/// The section `autopilot_sim`. Of `quadrotor.controller` velocity_d, tilt_max, rate_max, speed_max, drag_per_s and
/// lead_s do not count: an autopilot has the first four from its parameters, and leaves the others to the bridge.
struct SimulatedAutopilotConfig {
  Manners manners = Manners::Px4;
  double clock_rate = 0.99;
  double velocity_d = 0.2;
  Duration answer_after{100'000};
  Duration busy_for{2'000'000};
  QuadrotorConfig quadrotor;  ///< this and the next two are those of the section `simulator`
  WindSpec wind;
  EstimatorSpec estimator;

  template <typename V>
  void visit(V& v) {
    v("manners", manners, KnobWords<Manners>{{"px4", Manners::Px4}, {"ardupilot", Manners::ArduPilot}},
      "whose modes, take-off and messages are its own");
    v("clock_rate", clock_rate, Range{0.9, 1.1}, "seconds of its clock per second");
    v("answer_after_s", answer_after, Range{0.0, 2.0}, "acknowledgements come this late, s");
    v("busy_s", busy_for, Range{0.0, 60.0}, "so long after its start it rejects commands for the moment, s");
    v("velocity_d", velocity_d, Range{0.0, 2.0}, "MPC_XY_VEL_D_ACC: acceleration against all of its own, share");
  }
};

/// It stands on the ground at the origin of its local frame until it is armed. Pure: frames and times in, frames out.
///
/// As PX4 does: HEARTBEAT 1 Hz, SYS_STATUS and EXTENDED_SYS_STATE 5 Hz, LOCAL_POSITION_NED and ODOMETRY 30 Hz,
/// ATTITUDE_QUATERNION 50 Hz, TIMESYNC 10 Hz, other rates by SET_MESSAGE_INTERVAL. HIL_STATE_QUATERNION states no time.
///
/// Disarmed, it takes any mode. To be armed in OFFBOARD, or to take it in flight, it must have heard setpoints for half
/// a second. COM_OF_LOSS_T after the last one it does what COM_OBL_RC_ACT says; as soon as they come again, it takes
/// OFFBOARD up again. Setpoints are held, not carried on.
///
/// It is not armed while NAV_DLL_ACT asks for a ground station that is not heard. With EKF2_GPS_CTRL 0 it has a
/// position only while EKF2_EV_CTRL is 15 and ODOMETRY tells it; what it takes for its position is its model's all the
/// same. After arming, rotors spin up for a second, and take-off has its speed bit by bit within three more. Who has
/// not begun within 10 s is disarmed. It disarms when it has landed, and is then in the mode from before it landed.
///
/// Any system may command it, but has to say whom it means. A parameter is set by its own type only; of those it does
/// not have, it says nothing. The velocity loop has a D term, MPC_XY_VEL_D_ACC, which opposes the whole acceleration.
///
/// With ArduPilot's manners (Copter, by its source; no real one was asked) it says HEARTBEAT, SYS_STATUS and what
/// SET_MESSAGE_INTERVAL asked for: neither ESTIMATOR_STATUS nor HIL_STATE_QUATERNION, and ODOMETRY in another frame.
/// Its modes are GUIDED, LOITER and LAND. Setpoints do not lift it off the ground. NAV_TAKEOFF does, in GUIDED, to a
/// height above home, and a setpoint ends that. Setpoints are carried on until the next one. Home is where it was
/// armed, shifted up by SIM_HOME_UP. Who stands armed for 10 s without taking off is disarmed. GUID_TIMEOUT after the
/// last setpoint it stops, in GUIDED. It stays in LAND when it has landed. Parameters travel as numbers, whatever their
/// type.
///
/// Parameters beside PX4's: SIM_ARM_REFUSE (it refuses to arm), SIM_BAT_PCT (what is left, %), SIM_EST_JUMP (writing it
/// shifts the estimate by so many metres).
class SimulatedAutopilot {
 public:
  SimulatedAutopilot(const SimulatedAutopilotConfig& config, std::uint64_t seed, UTime now);

  void receive(const Frame& frame, UTime now);
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
  void receive_command(const CommandLong& command, Address from, UTime now);
  [[nodiscard]] std::uint8_t execute(const CommandLong& command, UTime now);
  [[nodiscard]] std::uint8_t set_mode(int main, int sub, UTime now);
  [[nodiscard]] std::uint8_t arm(UTime now);
  void disarm();
  void intend(Mode mode);
  void enter(Mode mode);
  [[nodiscard]] bool is_busy(UTime now) const { return now - started_ < config_.busy_for; }
  /// ArduPilot's own take-off: until it is up.
  [[nodiscard]] bool is_taking_off() const { return takes_off_to_ && command_.motion.p.z() < *takes_off_to_; }
  [[nodiscard]] bool is_ardupilot() const { return config_.manners == Manners::ArduPilot; }
  bool rotors_lift(UTime t);
  bool ardupilots_rotors_lift(UTime t);
  [[nodiscard]] std::uint8_t set_ardupilots_mode(int custom);
  [[nodiscard]] std::uint8_t take_off(float above_home, UTime now);
  void fly_guided(UTime t);
  void begin_streams(UTime now);
  void receive_vision(const Odometry& seen, UTime now);
  void receive_target(const SetPositionTargetLocalNed& target, UTime now);
  void set_parameter(const std::string& name, double value);
  void tune();
  void send_parameter(const std::string& name);
  void watch_offboard(UTime now);
  void fly(UTime now);
  void send_streams(UTime now);
  void send_stream(std::uint32_t id, UTime now);
  void send_odometry();
  void send_truth();
  void send_warning(const std::string& words);
  [[nodiscard]] std::uint64_t clock_us(UTime now) const;
  [[nodiscard]] bool has_stream(UTime now) const;
  [[nodiscard]] bool has_position(UTime now) const;
  [[nodiscard]] std::uint32_t custom_mode() const;
  template <class M>
  void send(const M& message) {
    out_.push_back(to_frame(message, kSelf, sequence_++));
  }

  static constexpr Address kSelf{1, 1};
  SimulatedAutopilotConfig config_;
  QuadrotorModel model_;
  UTime started_;
  bool armed_ = false;
  Mode mode_ = Mode::Position;
  Mode intended_ = Mode::Position, after_disarming_ = Mode::Position;
  bool failsafe_ = false;  ///< it flies mode_, not what was intended
  UavState command_;
  UavState target_;  ///< the newest setpoint, local ENU
  std::optional<UTime> streaming_since_, last_target_, landed_since_, ramp_since_;
  std::optional<UTime> ground_station_received_, vision_received_;
  UTime armed_since_;
  double home_up_ = 0.0;                ///< of the estimate's frame
  std::optional<double> takes_off_to_;  ///< of the estimate's frame
  bool guided_ = false;                 ///< by setpoints, since GUIDED began
  double ramp_ = 1.0;                   ///< of its speed, while it takes off
  UTime last_step_;
  double battery_ = 0.9;
  std::map<std::string, double> parameters_;
  std::map<std::uint32_t, Stream> streams_;
  std::deque<Answer> answers_;
  std::uint8_t sequence_ = 0;
  std::uint16_t text_id_ = 0;
  std::vector<Frame> out_;
};

}  // namespace tern::mavlink
