// The simulated autopilot's streams and acknowledgements.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mavlink/autopilot.h"
#include "mavlink/axes.h"
#include "mavlink/sim/simulated_autopilot.h"

namespace tern::mavlink {
namespace {

/// Geographic position of the local origin, 1e-7 degrees and mm.
constexpr std::int32_t kLatitude = 473977418, kLongitude = 85455938, kAltitude = 488'000;
constexpr std::uint8_t kPx4 = 12, kArduPilot = 3, kLocalNed = 1, kLocalFrd = 20;
/// MAV_STATE.
constexpr std::uint8_t kStandby = 3, kActive = 4, kCritical = 5;
/// ESTIMATOR_STATUS_FLAGS: attitude only; all flags that a flight needs.
constexpr std::uint16_t kAttitudeAlone = 0x0001, kAllAiding = 0x033F;

std::array<float, 3> rates_frd(const Vec3& w) {
  return {static_cast<float>(w.x()), static_cast<float>(-w.y()), static_cast<float>(-w.z())};
}

}  // namespace

void SimulatedAutopilot::begin_streams(UTime now) {
  const auto every = [&](std::uint32_t id, std::int64_t us) { streams_[id] = {Duration{us}, now}; };
  every(Heartbeat::kId, 1'000'000);
  every(SysStatus::kId, 200'000);
  if (is_ardupilot()) return;
  every(ExtendedSysState::kId, 200'000);
  every(EstimatorStatus::kId, 1'000'000);
  every(LocalPositionNed::kId, 33'333);
  every(Odometry::kId, 33'333);
  every(AttitudeQuaternion::kId, 20'000);
  every(Timesync::kId, 100'000);
}

std::uint64_t SimulatedAutopilot::clock_us(UTime now) const {
  return static_cast<std::uint64_t>(config_.clock_rate * static_cast<double>((now - started_).us));
}

std::uint32_t SimulatedAutopilot::custom_mode() const {
  const auto automatic = [](std::uint32_t sub) { return 4U << 16U | sub << 24U; };
  if (is_ardupilot()) return mode_ == Mode::Offboard ? 4 : mode_ == Mode::Land ? 9 : 5;
  switch (mode_) {
    case Mode::Loiter: return automatic(3);
    case Mode::Land: return automatic(6);
    case Mode::Position: return 3U << 16U;
    case Mode::Offboard: return 6U << 16U;
  }
  return 0;
}

void SimulatedAutopilot::state_errors(Odometry& m) const {
  constexpr float kTilt = 9e-6F, kHeading = 1e-4F;  // 0.17°, 0.57°
  const auto sigma = static_cast<float>(parameters_.at("SIM_ODO_SIGMA"));
  const auto velocity = static_cast<float>(parameters_.at("SIM_ODO_VEL"));
  m.pose_covariance.fill(std::numeric_limits<float>::quiet_NaN());
  m.velocity_covariance.fill(std::numeric_limits<float>::quiet_NaN());
  if (parameters_.at("SIM_ODO_NAN") != 0.0) return;
  for (const int k : {0, 6, 11}) m.pose_covariance[idx(k)] = sigma * sigma;
  for (const int k : {0, 6, 11}) m.velocity_covariance[idx(k)] = velocity * velocity;
  m.pose_covariance[15] = m.pose_covariance[18] = kTilt;
  m.pose_covariance[20] = kHeading;
}

void SimulatedAutopilot::send_odometry() {
  if (parameters_["SIM_ODO_OFF"] != 0.0) return;
  const UavState estimate = model_.estimate();
  const Eigen::Quaterniond q = swapped(model_.truth().q);
  Odometry m;
  m.time_usec = clock_us(estimate.at);
  m.p = ned_of(estimate.motion.p);
  m.q = wxyz_of(q);
  const Vec3 v = q.conjugate() * swapped(estimate.motion.v);
  m.v = {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
  m.rates = rates_frd(model_.truth().w);
  m.frame_id = is_ardupilot() ? kLocalFrd : kLocalNed;
  m.child_frame_id = 12;
  m.reset_counter = static_cast<std::uint8_t>(model_.resets());
  m.quality = static_cast<std::int8_t>(parameters_["SIM_ODO_QUAL"]);
  state_errors(m);
  send(m);
}

void SimulatedAutopilot::send_truth() {
  const VehicleTruth truth = model_.truth();
  constexpr double kMetres = 6'371'000.0 * std::numbers::pi / 180.0 * 1e-7;  // per unit of latitude
  const double shrink = std::cos(kLatitude * 1e-7 * std::numbers::pi / 180.0);
  HilStateQuaternion m;
  m.q = wxyz_of(swapped(truth.q));
  m.rates = rates_frd(truth.w);
  m.lat = kLatitude + static_cast<std::int32_t>(std::lround(truth.motion.p.y() / kMetres));
  m.lon = kLongitude + static_cast<std::int32_t>(std::lround(truth.motion.p.x() / (kMetres * shrink)));
  m.alt = kAltitude + static_cast<std::int32_t>(std::lround(truth.motion.p.z() * 1e3));
  const Vec3 v = 100.0 * swapped(truth.motion.v);
  for (int k = 0; k < 3; ++k) m.v[idx(k)] = static_cast<std::int16_t>(std::lround(std::clamp(v[k], -3e4, 3e4)));
  send(m);
}

void SimulatedAutopilot::send_stream(std::uint32_t id, UTime now) {
  const UavState estimate = model_.estimate();
  const auto boot_ms = static_cast<std::uint32_t>(clock_us(estimate.at) / 1000);
  const bool on_ground = model_.truth().on_ground;
  if (is_ardupilot() && (id == EstimatorStatus::kId || id == HilStateQuaternion::kId)) return;
  switch (id) {
    case GlobalPositionInt::kId:
      return send(GlobalPositionInt{
          .time_boot_ms = boot_ms,
          .relative_alt = static_cast<std::int32_t>(std::lround(1e3 * (estimate.motion.p.z() - home_up_)))});
    case Heartbeat::kId:
      return send(Heartbeat{.custom_mode = custom_mode(),
                            .type = 2,
                            .autopilot = is_ardupilot() ? kArduPilot : kPx4,
                            .base_mode = static_cast<std::uint8_t>(1 | (armed_ ? kArmedBit : 0)),
                            .system_status = !armed_     ? kStandby
                                             : failsafe_ ? kCritical
                                                         : kActive});
    case SysStatus::kId:
      return send(SysStatus{.voltage_battery = 15'000,
                            .battery_remaining = static_cast<std::int8_t>(std::lround(100.0 * battery_))});
    case ExtendedSysState::kId:
      return send(ExtendedSysState{.landed_state = static_cast<std::uint8_t>(on_ground             ? 1
                                                                             : mode_ == Mode::Land ? 4
                                                                             : is_taking_off()     ? 3
                                                                                                   : 2)});
    case EstimatorStatus::kId:
      return send(EstimatorStatus{.time_usec = clock_us(now),
                                  .ratios = {0.1F, 0.1F, 0.1F, 0.1F, 0.0F, 0.0F},
                                  .pos_horiz_accuracy = static_cast<float>(config_.estimator.position_sigma_m),
                                  .pos_vert_accuracy = static_cast<float>(config_.estimator.position_sigma_m),
                                  .flags = has_position(now) ? kAllAiding : kAttitudeAlone});
    case LocalPositionNed::kId:
      return send(LocalPositionNed{boot_ms, ned_of(estimate.motion.p), ned_of(estimate.motion.v)});
    case AttitudeQuaternion::kId:
      return send(AttitudeQuaternion{boot_ms, wxyz_of(swapped(model_.truth().q)), rates_frd(model_.truth().w), {}});
    case Timesync::kId: return send(Timesync{.ts1 = static_cast<std::int64_t>(clock_us(now)) * 1000});
    case GpsGlobalOrigin::kId:
      return send(GpsGlobalOrigin{.latitude = kLatitude, .longitude = kLongitude, .altitude = kAltitude});
    case Odometry::kId: return send_odometry();
    case HilStateQuaternion::kId: return send_truth();
    default: return;
  }
}

void SimulatedAutopilot::send_streams(UTime now) {
  for (auto& [id, stream] : streams_) {
    if (now < stream.next) continue;
    send_stream(id, now);
    stream.next = std::max(stream.next + stream.period, now - stream.period);
  }
  while (!answers_.empty() && answers_.front().due <= now) {
    send(answers_.front().ack);
    answers_.pop_front();
  }
}

}  // namespace tern::mavlink
