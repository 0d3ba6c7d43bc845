#include "executor/rejoin_guard.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/world/flyable.h"

namespace tern {
namespace {

std::string place(const Vec3& p) { return fmt::format("({:.2f}, {:.2f}, {:.2f})", p.x(), p.y(), p.z()); }

Box widened(const Box& box, double by) { return {box.min() - Vec3::Constant(by), box.max() + Vec3::Constant(by)}; }

}  // namespace

std::optional<std::string> RejoinGuard::check_start(const Vec3& p, const Vec3& start, bool has_flown) const {
  const char* hint = "are frame and unit of UAV_STATE right?";
  if (!excursion_.value_or(widened(allowed_, kStartOutside)).contains(p)) {
    return fmt::format("the vehicle is at {} m, outside uav.flight_box; uav.start is {}: {}", place(p), place(start),
                       hint);
  }
  if (!has_flown && (p - start).norm() > start_reach_m_) {
    return fmt::format("the vehicle is at {} m, {:.1f} m from uav.start {} (limit {:g} m): {}", place(p),
                       (p - start).norm(), place(start), start_reach_m_, hint);
  }
  return std::nullopt;
}

std::optional<std::string> RejoinGuard::check_rejoin(const Vec3& commanded, const Vec3& measured, bool counts,
                                                     UTime at) {
  if (!bound().contains(measured)) {
    return fmt::format("the vehicle is measured at {} m, too far outside uav.flight_box, and was commanded to {}",
                       place(measured), place(commanded));
  }
  if (!counts) return std::nullopt;
  const double by = (measured - commanded).norm();
  const Shift next{false, by, at};
  const double sum = sum_with(next);
  if (sum > kMaxShift) {
    return fmt::format(
        "the vehicle does not follow its setpoints: it is {:.2f} m off again, {:.2f} m in all (limit "
        "{:g} m). Is UAV_STATE in the frame that the autopilot flies in?",
        by, sum, kMaxShift);
  }
  keep(next, sum);
  return std::nullopt;
}

std::optional<std::string> RejoinGuard::check_reset(const Vec3& by, UTime at) {
  const Shift next{true, by.norm(), at};
  const double sum = sum_with(next);
  if (sum > kMaxShift) {
    return fmt::format("the estimator has shifted the vehicle by {:.2f} m, by {:.2f} m in all (limit {:g} m)", next.by,
                       sum, kMaxShift);
  }
  keep(next, sum);
  return std::nullopt;
}

double RejoinGuard::sum_with(const Shift& next) const {
  const double before = std::max(shift_ - kForgiven * (next.at - last_.at).seconds(), 0.0);
  const bool is_same = next.is_reset != last_.is_reset && next.at - last_.at <= kSameShift;
  return before + (is_same ? std::max(next.by - last_.by, 0.0) : next.by);
}

void RejoinGuard::keep(const Shift& next, double sum) {
  shift_ = sum;
  last_ = next;
}

void RejoinGuard::add_excursion(const Box& flown) {
  if (!excursion_ && !widened(allowed_, kBoxTolerance).contains(flown)) {
    excursion_ = widened(allowed_.merged(flown), kExcursionStep).merged(widened(allowed_, kMinExcursion));
  }
}

bool RejoinGuard::may_command(const Vec3& p) const { return bound().contains(p); }

Box RejoinGuard::bound() const { return excursion_.value_or(widened(allowed_, kMaxExcursion)); }

}  // namespace tern
