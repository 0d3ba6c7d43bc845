// The errors of the estimate: the autopilot's ODOMETRY or a companion's, and resets of the autopilot's estimator.
#include <fmt/format.h>

#include <algorithm>

#include "mavlink/bridge.h"

namespace tern::mavlink {
namespace {

/// A larger time_usec is one since the Unix epoch, a smaller one since the sender's start, as the message defines it.
constexpr std::uint64_t kUnixTimes = 1'000'000'000'000'000;
/// A message older than this, or farther ahead, is not used: its clock is wrong.
constexpr Duration kOldest{1'000'000}, kAhead{100'000};
/// A smaller step is not logged, m. While the frame turns, a fast vehicle leaves it by less between two estimates.
constexpr double kWorthALine = 0.05;

}  // namespace

std::optional<UavState> Bridge::state() const {
  const auto local = in_world(autopilot_.state());
  return local ? std::optional(frame_.flown(*local)) : std::nullopt;
}

void Bridge::take_estimate() {
  const auto odometry = autopilot_.take_odometry();
  if (config_.odometry == OdometrySource::None) return;
  if (odometry && config_.odometry == OdometrySource::Autopilot) {
    const auto& [message, at] = *odometry;
    at ? report_.add(message, *at) : report_.refuse("its time is unknown (TIMESYNC), or more than 1 s ago");
  }
  if (!autopilot_.state()) return;
  const double left = frame_.outstanding();
  const int jumps = frame_.jumps();
  frame_.add(*in_world(autopilot_.state()), autopilot_.resets());
  if (frame_.jumps() != jumps)
    out_.log("the autopilot's estimator has moved the vehicle too far to be followed slowly");
  if (frame_.outstanding() > left + kWorthALine) {
    out_.log(fmt::format("the autopilot's estimator has moved the vehicle: {:.2f} m to follow, at {:g} m/s",
                         frame_.outstanding(), FlownFrame::kSpeed));
  }
}

void Bridge::receive_companion(const Frame& frame, UTime received, const std::function<UTime(std::int64_t)>& of_unix) {
  if (const auto m = from_frame<Timesync>(frame); m && m->tc1 == 0) {
    companion_out_.send(Timesync{.tc1 = received.us * 1000, .ts1 = m->ts1});
  } else if (m) {
    companion_clock_.add(UTime{m->ts1 / 1000}, m->tc1 / 1000, received);
  }
  const auto m = from_frame<Odometry>(frame);
  if (!m || config_.odometry != OdometrySource::Companion) return;
  const auto theirs = static_cast<std::int64_t>(std::min<std::uint64_t>(m->time_usec, INT64_MAX / 2));
  const auto at = m->time_usec > kUnixTimes ? of_unix(theirs) : companion_clock_.ours(theirs);
  if (!at) return report_.refuse("its clock is unknown: time_usec is no Unix time, and TIMESYNC is not answered");
  if (received - *at > kOldest || *at - received > kAhead) {
    return report_.refuse(fmt::format("its time is {:.1f} s off: are the clocks set?", (received - *at).seconds()));
  }
  report_.add(*m, std::min(*at, received));
  const auto& estimate = report_.newest();
  if (!estimate || estimate->at != std::min(*at, received)) return;
  const OdometryOffset T_WO{estimate->p_WO, estimate->yaw_WO, estimate->epoch};
  UavState seen;
  seen.at = estimate->at;
  seen.motion.p = T_WO.to_W(PointInO{estimate->p_OB}).xyz - origin_;
  seen.motion.v = T_WO.to_W(VectorInO{estimate->v_OB}).xyz;
  if (estimate->state == EstimatorState::Tracking) vision_.sent(seen);
}

}  // namespace tern::mavlink
