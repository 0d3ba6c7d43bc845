// The bridge's messages to the autopilot: streams, setpoints, external vision.
#include <limits>
#include <utility>

#include "mavlink/axes.h"
#include "mavlink/bridge.h"

namespace tern::mavlink {
namespace {

constexpr std::uint8_t kGroundStation = 6, kOnboardController = 18, kNoAutopilot = 8, kActive = 4;
/// A PX4 handles no other message for about 10 ms per requested stream, so requests are rare in flight.
constexpr Duration kStreamsPeriod{2'000'000}, kStreamsPeriodInFlight{30'000'000};
/// COM_OF_LOSS_T's default, s.
constexpr double kOffboardLoss = 1.0;
/// 50 Hz.
constexpr Duration kVisionPeriod{20'000};
/// After a longer pause of setpoints, the offset of an ArduPilot's begins anew.
constexpr Duration kOffsetGap{500'000};
constexpr std::uint16_t kAllButYawRate = 0x0800;
constexpr std::uint8_t kLocalNed = 1, kVision = 2;
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

}  // namespace

bool Bridge::is_ground_station() const {
  constexpr double kNotRead = -1.0;
  return autopilot_.stack().tells_ground_stations_only() &&
         value_or(autopilot_.parameters(), "NAV_DLL_ACT", kNotRead) == 0.0;
}

void Bridge::send_heartbeats() {
  out_.send(Heartbeat{.type = kOnboardController, .autopilot = kNoAutopilot, .system_status = kActive});
  if (!is_ground_station()) return;
  out_.send_as_ground_station(Heartbeat{.type = kGroundStation, .autopilot = kNoAutopilot, .system_status = kActive});
}

void Bridge::request_streams(UTime now) {
  if (!autopilot_.address() || !next_streams_.take(now, flies() ? kStreamsPeriodInFlight : kStreamsPeriod)) return;
  std::vector<StreamRequest> streams{{Odometry::kId, 10'000},
                                     {HilStateQuaternion::kId, 10'000},
                                     {EstimatorStatus::kId, 200'000},
                                     {ExtendedSysState::kId, 200'000}};
  for (const StreamRequest& stream : autopilot_.stack().streams()) streams.push_back(stream);
  for (const auto& [message, interval_us] : streams) {
    out_.request(kSetMessageInterval, {static_cast<float>(message), interval_us});
  }
  out_.request(kRequestMessage, {static_cast<float>(GpsGlobalOrigin::kId)});
}

void Bridge::request_parameters(UTime now) {
  const bool may_write = config_.set_parameters && !config_.list_parameters && !autopilot_.armed();
  parameters_.request(required(), autopilot_, {may_write, config_.raise_bounds}, now, out_);
}

void Bridge::receive_vision(const UavState& seen) {
  UavState local = seen;
  local.motion.p -= origin_;
  send_vision(local);
}

/// The attitude is level: an estimator uses position, velocity and heading, and measures its tilt by itself.
void Bridge::send_vision(const UavState& local) {
  if (!config_.external_vision || !autopilot_.address() || local.at < sent_vision_ + kVisionPeriod) return;
  sent_vision_ = local.at;
  vision_.sent(local);
  const Eigen::Quaterniond level(Eigen::AngleAxisd(local.yaw, Vec3::UnitZ()));
  Odometry m;
  m.time_usec = static_cast<std::uint64_t>(local.at.us);
  m.p = ned_of(local.motion.p);
  m.q = wxyz_of(swapped(level));
  m.v = ned_of(local.motion.v);
  m.rates.fill(kUnknown);
  m.pose_covariance[0] = m.velocity_covariance[0] = kUnknown;
  m.frame_id = m.child_frame_id = kLocalNed;
  m.estimator_type = kVision;
  m.quality = 100;
  out_.send(m);
}

bool Bridge::may_be_in_failsafe(UTime now) const {
  if (!autopilot_.stack().setpoints_end_failsafe()) return false;
  if (!flies()) return autopilot_.in_failsafe() && !ordered_by_goal_;
  return autopilot_.silence(now).seconds() > value_or(autopilot_.parameters(), "COM_OF_LOSS_T", kOffboardLoss);
}

/// A vehicle that takes off by command gets no setpoint before it is up.
bool Bridge::is_silent() const {
  const Stage stage = at_.stage;
  if (stage == Stage::Landing && at_.landing_seen) return true;
  if (autopilot_.stack().takes_off_by_command()) {
    const bool flown = stage == Stage::Climbing || stage == Stage::Following;
    return !flown && !(stage == Stage::Landing && streaming_since_);
  }
  return stage == Stage::Waiting || stage == Stage::Landed ||
         (stage == Stage::StoodBack && config_.start == Start::Arm);
}

Duration Bridge::lead() const {
  return config_.lead_s > 0.0 ? Duration::from_seconds(config_.lead_s)
                              : autopilot_.stack().tilt_lag(autopilot_.parameters());
}

/// The acceleration that makes a vehicle with loops like a PX4's fly `m`.
Vec3 Bridge::fed_forward(const MotionSample& m, bool following, UTime now) const {
  const Vec3 ahead = following ? command_.acceleration_ahead(now, lead()) : m.a;
  const Vec3 v_ahead = m.v + 0.5 * lead().seconds() * (m.a + ahead);
  const Vec3 opposed = autopilot_.stack().derivative_gain(autopilot_.parameters()).cwiseProduct(m.a);
  return config_.acceleration_gain * (ahead + opposed) + config_.drag_per_s * v_ahead;
}

/// The setpoint that makes the vehicle fly `m`.
MotionSample Bridge::with_feed_forward(const MotionSample& m, bool following, UTime now) {
  MotionSample sent = m;
  const auto loops = autopilot_.stack().integrating_loops(autopilot_.parameters());
  if (!loops) {
    sent.a = fed_forward(m, following, now);
    return sent;
  }
  const Duration since = now - std::exchange(offset_at_, now);
  if (since > kOffsetGap) {
    offset_.reset();
    return sent;
  }
  const Vec3 beyond = following ? Vec3(fed_forward(m, following, now) - m.a) : Vec3::Zero();
  const MotionSample& offset = offset_.step(beyond, *loops, since.seconds());
  sent.p += offset.p;
  sent.v += offset.v;
  sent.a += offset.a;
  return sent;
}

void Bridge::stream(UTime now) {
  const FlightStack& stack = autopilot_.stack();
  const bool holds_blindly = at_.stage == Stage::StoodBack && !(autopilot_.linked(now) && estimate_fault(now).empty());
  const Duration period = Duration::from_seconds(1.0 / config_.rate_hz);
  if (is_silent() || holds_blindly || may_be_in_failsafe(now) || !next_target_.take(now, period)) return;
  if (at_.stage == Stage::StoodBack) hold_here(now);
  const bool following = at_.stage == Stage::Following && followed_;
  if (!following && !own_) return;
  if (!streaming_since_) streaming_since_ = now;
  // A setpoint that is held for a period is right on average if it is right in the middle.
  const Duration held = stack.holds_setpoints() ? Duration{period.us / 2} : Duration{};
  const MotionSample m = following ? command_.sample(now + held) : own_->motion;
  const double yaw = following ? command_.yaw() : own_->yaw;
  const MotionSample sent = with_feed_forward(m, following, now);
  if (following) {
    last_sent_.motion = m;
    last_sent_.yaw = yaw;
    tracking_.sent(sent);
  }
  const MotionSample there = frame_.commanded(sent);
  SetPositionTargetLocalNed target;
  target.time_boot_ms = static_cast<std::uint32_t>(autopilot_.clock().theirs_us(now).value_or(0) / 1000);
  target.p = ned_of(there.p - origin_);
  target.v = ned_of(there.v);
  target.a = ned_of(there.a);
  target.yaw = static_cast<float>(swapped_yaw(frame_.commanded_yaw(yaw)));
  target.type_mask = kAllButYawRate;
  target.target_system = out_.target().system;
  target.target_component = out_.target().component;
  target.coordinate_frame = kLocalNed;
  out_.send(target);
}

}  // namespace tern::mavlink
