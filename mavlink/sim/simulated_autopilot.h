// A simulated autopilot behind MAVLink: the simulator's quadrotor, with behaviour that was measured on PX4.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "mavlink/messages.h"
#include "mavlink/sim/guided_loops.h"
#include "mavlink/sim/guided_shaper.h"
#include "simulator/vehicle/quadrotor_model.h"

namespace tern::mavlink {

/// The firmware whose behaviour is simulated.
enum class Manners : std::uint8_t { Px4, ArduPilot };

/// The section `autopilot_sim`.
///
/// Of `quadrotor.controller`, drag_per_s and lead_s are ignored: they are the bridge's. The simulated PX4 has its gains
/// and limits from its parameters, the simulated ArduPilot its limits.
struct SimulatedAutopilotConfig {
  Manners manners = Manners::Px4;
  double clock_rate = 0.99;
  double velocity_d = 0.2;
  bool tuned = false;
  Duration answer_after{100'000};
  Duration busy_for{2'000'000};
  QuadrotorConfig quadrotor;  ///< this and the next two are read from the section `simulator`
  WindSpec wind;
  EstimatorSpec estimator;

  template <typename V>
  void visit(V& v) {
    v("manners", manners, KnobWords<Manners>{{"px4", Manners::Px4}, {"ardupilot", Manners::ArduPilot}},
      "firmware whose modes, take-off and messages are simulated");
    v("clock_rate", clock_rate, Range{0.9, 1.1}, "seconds of the autopilot's clock per second");
    v("answer_after_s", answer_after, Range{0.0, 2.0}, "delay of acknowledgements, s");
    v("busy_s", busy_for, Range{0.0, 60.0}, "how long the autopilot rejects commands temporarily after its start, s");
    v("velocity_d", velocity_d, Range{0.0, 2.0},
      "MPC_XY_VEL_D_ACC: D gain of the velocity loop, which opposes the whole acceleration");
    v("tuned", tuned,
      "its parameters are the gains and limits of `simulator.quadrotor.controller`; false: the firmware's defaults");
  }
};

/// A vehicle with an autopilot. It stands on the ground at the origin of its local frame until it is armed. Pure:
/// frames and times in, frames out.
///
/// | behaviour       | PX4, as measured                               | ArduPilot Copter, from its source            |
/// |-----------------|------------------------------------------------|----------------------------------------------|
/// | modes           | POSCTL, OFFBOARD, AUTO.LOITER, AUTO.LAND       | LOITER, GUIDED, LAND                         |
/// | streams         | see below                                      | HEARTBEAT 1 Hz, SYS_STATUS 5 Hz              |
/// | following mode  | needs setpoints for 0.5 s to arm, or in flight | at any time                                  |
/// | setpoints       | held until the next one                        | extrapolated, and shaped (GuidedShaper)      |
/// | level loops     | those of the model, with PX4's parameters      | GuidedLoops, with Copter's parameters        |
/// | setpoints cease | after COM_OF_LOSS_T: COM_OBL_RC_ACT            | after GUID_TIMEOUT: comes back to the place  |
/// |                 |                                                | of that moment, in GUIDED                    |
/// | setpoints again | returns to OFFBOARD                            | follows them                                 |
/// | take-off        | by setpoints: spin-up 1 s, speed ramp 3 s      | by NAV_TAKEOFF; a setpoint ends it           |
/// | tilt limit      | MPC_TILTMAX_LND (12°) until the speed ramp has | ATC_ANGLE_MAX                                |
/// |                 | ended, then 11.5°/s up to MPC_TILTMAX_AIR      |                                              |
/// | no take-off     | disarms after 10 s                             | disarms after 10 s                           |
/// | after landing   | disarms; the mode is that before landing       | disarms; stays in LAND                       |
/// | parameters      | integers bytewise; only the right type is set  | numbers, of any type                         |
///
/// Streams of PX4: HEARTBEAT and ESTIMATOR_STATUS 1 Hz, SYS_STATUS and EXTENDED_SYS_STATE 5 Hz, LOCAL_POSITION_NED and
/// ODOMETRY 30 Hz, ATTITUDE_QUATERNION 50 Hz, TIMESYNC 10 Hz. SET_MESSAGE_INTERVAL adds streams and changes rates.
/// HIL_STATE_QUATERNION has no time. An ArduPilot never sends ESTIMATOR_STATUS or HIL_STATE_QUATERNION, and sends
/// ODOMETRY in another frame.
///
/// Further rules:
/// - Disarmed, it accepts any mode.
/// - PX4 sends STATUSTEXT only while a HEARTBEAT of type ground station was received on its link within 2.5 s.
/// - PX4 refuses to arm while NAV_DLL_ACT requires a ground station and none sends HEARTBEAT.
/// - With EKF2_GPS_CTRL 0 it has a position only while EKF2_EV_CTRL is 15 and ODOMETRY arrives. It reports the model's
///   position and velocity in any case.
/// - If ODOMETRY comes back after more than 0.4 s, the estimate of such a vehicle jumps up by SIM_EV_JUMP, and back
///   after 5 s. The default is 8.3 m, as measured. Setpoints stay where they were sent; own modes move along.
/// - Any system may command it, with the right target. REQUEST_MESSAGE may be for all systems. Requests for unknown
///   parameters get no answer.
/// - The velocity loop has the D term MPC_XY_VEL_D_ACC, which opposes the whole acceleration.
/// - ArduPilot's home is where it was armed, shifted up by SIM_HOME_UP.
///
/// Own parameters: SIM_ARM_REFUSE (refuses to arm), SIM_BAT_PCT (battery charge, %), SIM_EST_JUMP (writing it shifts
/// the estimate by so many metres), SIM_EV_JUMP. ODOMETRY states variances and no correlations, as a PX4 does. Its
/// position has the deviation SIM_ODO_SIGMA (m), which grows by SIM_ODO_GROW (m/s). With SIM_ODO_NAN it states none.
/// The velocity's deviation is SIM_ODO_VEL (m/s). SIM_ODO_QUAL is its quality, and SIM_ODO_OFF ends it.
class SimulatedAutopilot {
 public:
  SimulatedAutopilot(const SimulatedAutopilotConfig& config, std::uint64_t seed, UTime now);

  /// @param on_its_link  false: over a link of its own, as of a ground station
  void receive(const Frame& frame, UTime now, bool on_its_link = true);
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
  /// ArduPilot: NAV_TAKEOFF is under way.
  [[nodiscard]] bool is_taking_off() const { return takes_off_to_ && command_.motion.p.z() < *takes_off_to_; }
  [[nodiscard]] bool is_ardupilot() const { return config_.manners == Manners::ArduPilot; }
  bool rotors_lift(UTime t);
  bool ardupilots_rotors_lift(UTime t);
  [[nodiscard]] std::uint8_t set_ardupilots_mode(int custom);
  [[nodiscard]] std::uint8_t take_off(float above_home, UTime now);
  void fly_guided(UTime t);
  [[nodiscard]] ShapingLimits level_shaping() const;
  [[nodiscard]] ShapingLimits vertical_shaping() const;
  [[nodiscard]] CopterLoops level_loops() const;
  void begin_streams(UTime now);
  void receive_vision(const Odometry& seen, UTime now);
  void jump_up(double metres);
  void receive_target(const SetPositionTargetLocalNed& target, UTime now);
  /// The firmware's defaults, apart from hover thrust and velocity gain, which the configuration states.
  static std::map<std::string, double> default_parameters(const SimulatedAutopilotConfig& config);
  static QuadrotorConfig bare(const SimulatedAutopilotConfig& config);
  void receive_parameters(const Frame& frame);
  void set_parameter(const std::string& name, double value);
  void take_tuned_parameters();
  void limit_tilt(double dt);
  void tune();
  void send_parameter(const std::string& name);
  void watch_offboard(UTime now);
  void fly(UTime now);
  void grow_sigma(double dt);
  void send_streams(UTime now);
  void send_stream(std::uint32_t id, UTime now);
  void send_odometry();
  void state_errors(Odometry& m) const;
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
  static bool is_mine(std::uint8_t system, std::uint8_t component) {
    return system == kSelf.system && (component == 0 || component == kSelf.component);
  }
  SimulatedAutopilotConfig config_;
  QuadrotorModel model_;
  UTime started_;
  bool armed_ = false;
  Mode mode_ = Mode::Position;
  Mode intended_ = Mode::Position, after_disarming_ = Mode::Position;
  bool failsafe_ = false;  ///< mode_ is that of the failsafe, not intended_
  UavState command_;
  UavState target_;  ///< newest setpoint, local ENU
  std::optional<UTime> streaming_since_, last_target_, landed_since_, ramp_since_;
  std::optional<UTime> ground_station_received_, linked_ground_station_received_, vision_received_;
  std::optional<UTime> jumps_back_;  ///< the estimate's jump after a gap of the vision ends
  double jumped_up_ = 0.0;           ///< by that, m
  UTime armed_since_;
  double home_up_ = 0.0;                ///< in the estimate's frame, m
  std::optional<double> takes_off_to_;  ///< in the estimate's frame, m
  bool guided_ = false;                 ///< setpoints were received since GUIDED began
  GuidedShaper shaper_;
  GuidedLoops loops_;
  double ramp_ = 1.0;      ///< share of its speed during take-off
  double tilt_deg_ = 0.0;  ///< present tilt limit
  UTime last_step_, now_;
  double battery_ = 0.9;
  std::map<std::string, double> parameters_;
  std::map<std::uint32_t, Stream> streams_;
  std::deque<Answer> answers_;
  std::uint8_t sequence_ = 0;
  std::uint16_t text_id_ = 0;
  std::vector<Frame> out_;
};

}  // namespace tern::mavlink
