#include "mavlink/autopilot.h"

#include <bit>
#include <cmath>
#include <numbers>

#include "core/world/estimate_jump.h"
#include "mavlink/axes.h"

namespace tern::mavlink {
namespace {

constexpr std::uint8_t kAutopilotComponent = 1, kPx4 = 12, kArduPilot = 3, kInvalid = 8;
constexpr std::uint8_t kInt32 = 6;
constexpr std::uint8_t kFrameLocalNed = 1;
constexpr std::uint8_t kOnGround = 1, kTakingOff = 3;
constexpr std::uint8_t kWarning = 4;
/// MAV_STATE that an autopilot reports in a failsafe while armed.
constexpr std::uint8_t kCritical = 5, kEmergency = 6;
/// ODOMETRY silences LOCAL_POSITION_NED for this long: less than kStateAge, so that its end is no gap of the position.
constexpr Duration kOdometryRules{400'000};
/// Largest number of queued acknowledgements and texts.
constexpr std::size_t kMaxQueued = 64;
constexpr std::size_t kMaxParameters = 4096, kMaxText = 400;

/// A gap of the position that is shorter than this counts as an input fault.
constexpr Duration kFaultPasses{1'000'000};
/// ESTIMATOR_STATUS_FLAGS.
constexpr unsigned kVelocity = 2, kPositionRelative = 8, kPositionAbsolute = 16, kAccelerometerWrong = 2048;

template <class T>
void keep(std::deque<T>& queue, const T& value) {
  queue.push_back(value);
  if (queue.size() > kMaxQueued) queue.pop_front();
}

bool all_finite(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  return std::all_of(a.begin(), a.end(), [](float x) { return std::isfinite(x); }) &&
         std::all_of(b.begin(), b.end(), [](float x) { return std::isfinite(x); });
}

/// Metres north and east of the origin on a sphere, as PX4 projects (azimuthal equidistant).
Vec3 ned_from(const GpsGlobalOrigin& origin, std::int32_t lat, std::int32_t lon, std::int32_t alt_mm) {
  constexpr double kEarthRadius = 6'371'000.0, kRadians = std::numbers::pi / 180.0 * 1e-7;
  const double a = origin.latitude * kRadians, b = lat * kRadians;
  const double turn = (static_cast<double>(lon) - origin.longitude) * kRadians;
  const double cosine = std::clamp(std::sin(a) * std::sin(b) + std::cos(a) * std::cos(b) * std::cos(turn), -1.0, 1.0);
  const double angle = std::acos(cosine), k = angle < 1e-9 ? 1.0 : angle / std::sin(angle);
  return {k * (std::cos(a) * std::sin(b) - std::sin(a) * std::cos(b) * std::cos(turn)) * kEarthRadius,
          k * std::cos(b) * std::sin(turn) * kEarthRadius, (origin.altitude - alt_mm) * 1e-3};
}

/// Whether the position is that of the message before, although the vehicle moves: PX4's Gazebo updates attitude and
/// velocity more often than position.
bool is_stale(const HilStateQuaternion& hil, const std::optional<HilStateQuaternion>& before) {
  constexpr double kMoves = 30.0;  // cm/s: between two positions by more than the message resolves
  if (!before || hil.lat != before->lat || hil.lon != before->lon || hil.alt != before->alt) return false;
  return Vec3(hil.v[0], hil.v[1], hil.v[2]).norm() > kMoves;
}

}  // namespace

std::string result_text(std::uint8_t result) {
  constexpr std::array kWords{"accepted", "temporarily rejected", "denied",   "unsupported",
                              "failed",   "in progress",          "cancelled"};
  return result < kWords.size() ? kWords[result] : "result " + std::to_string(result);
}

Firmware Autopilot::firmware() const {
  if (heartbeat_.autopilot == kPx4) return Firmware::Px4;
  return heartbeat_.autopilot == kArduPilot ? Firmware::ArduPilot : Firmware::Other;
}

std::string Autopilot::mode() const { return address_ ? stack().mode(heartbeat_.custom_mode) : ""; }

bool Autopilot::in_failsafe() const {
  return armed() && (heartbeat_.system_status == kCritical || heartbeat_.system_status == kEmergency);
}

bool Autopilot::comes_down() const { return landing() || mode().ends_with("RTL"); }

std::string Autopilot::last_warning() const {
  const bool says_no_reason = warning_.starts_with("Arming denied") && !failed_check_.empty();
  return says_no_reason ? warning_ + "; " + failed_check_ : warning_;
}

void Autopilot::receive_text(const StatusText& chunk) {
  // A long text is sent in chunks with one id; the last one is zero-terminated.
  if (chunk.id == 0 || chunk.id != text_id_ || chunk.chunk_seq == 0) text_.clear();
  text_id_ = chunk.id;
  const std::string_view bytes = bytes_of(chunk.text);
  text_ += bytes;
  if (chunk.id != 0 && bytes.size() == chunk.text.size() && text_.size() < kMaxText) return;
  const std::string words = printable(std::exchange(text_, {}));
  keep(texts_, words);
  if (chunk.severity > kWarning) return;
  warning_ = words;
  if (words.starts_with("Preflight Fail")) failed_check_ = words;
}

bool Autopilot::receive(const Frame& frame, UTime received) {
  const auto heartbeat = from_frame<Heartbeat>(frame);
  if (!address_ && heartbeat && frame.from.component == kAutopilotComponent && heartbeat->autopilot != kInvalid &&
      (wanted_ == 0 || frame.from.system == wanted_)) {
    address_ = frame.from;
  }
  if (!address_ || frame.from != *address_) {
    ++strangers_;
    return false;
  }
  if (received - last_received_ > kLinkSilence) mode_is_old_ = true;
  longest_gap_ = std::max(longest_gap_, received - last_received_);
  last_received_ = received;
  if (heartbeat) {
    const bool was_armed = armed();
    heartbeat_ = *heartbeat;
    mode_received_ = received;
    if (armed() != was_armed) {
      arming_changed_ = received;
      home_height_.reset();
    }
    mode_is_old_ = false;
    longest_gap_ = Duration{};
    if (armed()) failed_check_.clear();
  }
  if (const auto m = from_frame<SysStatus>(frame); m && m->battery_remaining >= 0) {
    battery_ = std::min(m->battery_remaining / 100.0, 1.0);
  }
  if (const auto m = from_frame<ExtendedSysState>(frame); m && m->landed_state != 0) {
    landed_ = m->landed_state == kOnGround;
    taking_off_ = m->landed_state == kTakingOff;
  }
  if (const auto m = from_frame<EstimatorStatus>(frame)) receive_health(*m, received);
  if (const auto m = from_frame<Timesync>(frame); m && m->tc1 != 0) {
    clock_.add(UTime{m->ts1 / 1000}, m->tc1 / 1000, received);
  }
  if (const auto m = from_frame<GpsGlobalOrigin>(frame); m && !own_origin_) origin_ = *m;
  if (const auto m = from_frame<ParamValue>(frame)) receive_parameter(*m);
  if (const auto m = from_frame<CommandAck>(frame)) keep(acks_, *m);
  if (const auto m = from_frame<StatusText>(frame)) receive_text(*m);
  receive_position(frame, received);
  if (const auto m = from_frame<GlobalPositionInt>(frame); m && state_ && received - state_->at < kStateAge) {
    home_height_ = state_->motion.p.z() - m->relative_alt * 1e-3;
  }
  if (const auto m = from_frame<HilStateQuaternion>(frame)) receive_truth(*m, received);
  return true;
}

std::optional<UTime> Autopilot::ours(std::uint64_t theirs_us, UTime received) const {
  if (theirs_us > static_cast<std::uint64_t>(INT64_MAX)) return std::nullopt;
  const auto at = clock_.ours(static_cast<std::int64_t>(theirs_us));
  if (!at || received - *at > Duration{1'000'000}) return std::nullopt;
  return std::min(*at, received);  // the fit may be slightly ahead of the receive time
}

void Autopilot::receive_position(const Frame& frame, UTime received) {
  if (const auto m = from_frame<AttitudeQuaternion>(frame)) yaw_ = yaw_of(swapped(quaternion_of(m->q)));
  if (const auto m = from_frame<Odometry>(frame)) {
    if (reset_counter_ && *reset_counter_ != m->reset_counter) ++resets_;
    reset_counter_ = m->reset_counter;
    const auto at = ours(m->time_usec, received);
    odometry_.emplace(*m, at);
    const Eigen::Quaterniond q = quaternion_of(m->q);
    if (!at || m->frame_id != kFrameLocalNed || !all_finite(m->p, m->v) || !(std::abs(q.norm() - 1.0) < 0.1)) return;
    Vec3 v(m->v[0], m->v[1], m->v[2]);
    if (m->child_frame_id != kFrameLocalNed) v = q.normalized() * v;
    UavState state;
    state.at = *at;
    state.motion.p = enu_of(m->p);
    state.motion.v = swapped(v);
    state.yaw = wrapped(yaw_of(swapped(q.normalized())));
    if (!state_ || state.at > state_->at) state_ = state;
    last_odometry_ = received;
  }
  if (const auto m = from_frame<LocalPositionNed>(frame)) {
    if (last_odometry_ && received - *last_odometry_ < kOdometryRules) return;
    const auto at = ours(std::uint64_t{m->time_boot_ms} * 1000, received);
    if (!at || !all_finite(m->p, m->v)) return;
    UavState state;
    state.at = *at;
    state.motion.p = enu_of(m->p);
    state.motion.v = enu_of(m->v);
    state.yaw = wrapped(yaw_);
    if (state_ && state.at <= state_->at) return;
    if (state_ && estimate_jumps(state_->motion.p, state_->motion.v, state.motion.p, state.at - state_->at)) ++resets_;
    state_ = state;
  }
}

void Autopilot::receive_health(const EstimatorStatus& status, UTime received) {
  health_ = status;
  health_received_ = received;
  const bool position = (status.flags & (kPositionRelative | kPositionAbsolute)) != 0;
  if (position && (status.flags & kVelocity) != 0) placed_ = received;
}

void Autopilot::receive_truth(const HilStateQuaternion& hil, UTime received) {
  if (hil.lat == 0 && hil.lon == 0 && hil.alt == 0) return;  // not known yet
  if (is_stale(hil, std::exchange(last_truth_, hil))) return;
  const std::optional<UTime> at = hil.time_usec == 0 ? received : ours(hil.time_usec, received);
  if (!at || (truth_ && *at <= truth_->at)) return;
  if (!origin_ && own_origin_) {
    const bool known = state_ && std::abs((*at - state_->at).seconds()) < kStateAge.seconds();
    if (armed() && !known) return;
    if (armed()) own_shift_ = state_->motion.p + state_->motion.v * (*at - state_->at).seconds();
    origin_ = GpsGlobalOrigin{.latitude = hil.lat, .longitude = hil.lon, .altitude = hil.alt};
  }
  if (!origin_) return;
  UavState truth;
  truth.at = *at;
  truth.motion.p = swapped(ned_from(*origin_, hil.lat, hil.lon, hil.alt)) + own_shift_;
  truth.motion.v = swapped(Vec3(hil.v[0], hil.v[1], hil.v[2]) * 0.01);
  truth.yaw = wrapped(yaw_of(swapped(quaternion_of(hil.q))));
  truth_ = truth;
}

void Autopilot::receive_parameter(const ParamValue& value) {
  double number = value.param_value;
  if (stack().sends_integers_bytewise() && value.param_type == kInt32) {
    number = std::bit_cast<std::int32_t>(value.param_value);
  }
  if (parameters_.size() < kMaxParameters) parameters_[string_of(value.param_id)] = number;
}

EstimatorHealth Autopilot::estimator() const {
  if (!health_) return state_ ? EstimatorHealth::Degraded : EstimatorHealth::Lost;
  if (!placed_ || health_received_ - *placed_ >= kFaultPasses) return EstimatorHealth::Lost;
  const auto& r = health_->ratios;
  const bool is_whole = *placed_ == health_received_ && (health_->flags & kAccelerometerWrong) == 0;
  const bool believed = r[0] < 1.0F && r[1] < 1.0F && r[2] < 1.0F;
  return is_whole && believed ? EstimatorHealth::Good : EstimatorHealth::Degraded;
}

Vec3 Autopilot::sigma() const {
  if (!health_) return Vec3::Zero();
  // PX4's horizontal accuracy is the square root of the sum of both axes' variances.
  const double level = health_->pos_horiz_accuracy / std::numbers::sqrt2, up = health_->pos_vert_accuracy;
  const auto sane = [](double x) { return std::isfinite(x) && x >= 0.0 && x < 1e6 ? x : 0.0; };
  return {sane(level), sane(level), sane(up)};
}

}  // namespace tern::mavlink
