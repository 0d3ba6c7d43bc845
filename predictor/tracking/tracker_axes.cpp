// Tracker's rest on single axes of W. docs/prediction/rest_on_an_axis.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "predictor/tracking/tracker.h"

namespace tern {
namespace {

double distance2(const AxisFilter& of, double z, double r) { return (z - of.x) * (z - of.x) / (of.xx + r); }

}  // namespace

void Tracker::update_rest_of_axes(TrackedObject& object, const Detection& detection, UTime at, UTime seen,
                                  AxisRestRecords& records) const {
  const MotionFilter moving = object.moving.lead();
  for (int axis = 0; axis < 3; ++axis) {
    const double z = detection.position[axis], r = std::max(detection.variance[axis], kMinVariance);
    if (r >= kNoPosition) continue;
    AxisRest& rest = object.rest_of_axes[idx(axis)];
    RestRecord& record = records[idx(axis)];
    const bool rested = object.confirmed && seen - rest.since >= config_.resting_after && is_slow(rest.filter);
    rest.average += kRestingForgetting * (distance2(rest.filter, z, r) - rest.average);
    const bool is_restarted = object.born == at;
    if (is_restarted || rest.average > kAxisRestLimit) {
      rest = {moving.marginal(axis), at, 1.0, rested ? rest.filter : rest.stood};
    } else {
      rest.filter.update(z, r);
      if (rested) {
        record.rested_s += (at - seen).seconds();
        rest.stood.reset();
      }
    }
    if (rest.stood && distance2(*rest.stood, z, r) > kJumpGate) {
      ++record.starts;
      rest.stood.reset();
    }
  }
}

bool Tracker::is_stationary(const TrackedObject& object, int axis) const {
  const AxisRest& rest = object.rest_of_axes[idx(axis)];
  if (!object.confirmed || object.last_seen - rest.since < config_.resting_after) return false;
  if (!object.is_sighted) return is_slow(rest.filter);
  const bool is_seen = object.rejected[idx(axis)] == 0 && object.located_at[idx(axis)] == object.last_seen;
  return is_seen && object.faces.has_position(axis) &&
         std::abs(rest.filter.v) + 2.0 * std::sqrt(rest.filter.vv) <= kKnownRest;
}

void Tracker::narrow_resting_axes(const TrackedObject& object, const State& state, UTime from,
                                  std::vector<Waypoint>& waypoints) const {
  const bool is_unseen = (from - object.last_seen).seconds() > kUnseenAfter;
  const double speed = top_speed();
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_stationary(object, axis)) continue;
    std::array<double, kConfidenceLevels.size()> trusted_s;
    for (std::size_t level = 0; level < trusted_s.size(); ++level) {
      const double missed = 1.0 - confidence_at(config_.prediction.confidence, is_unseen ? 0 : static_cast<int>(level));
      trusted_s[level] = trusted_rest_s(state.rest_of_axes[idx(axis)], kStartShare * missed);
    }
    const AxisFilter& place = object.rest_of_axes[idx(axis)].filter;
    const double unnoticed = std::abs(object.position[axis] - place.x);
    const double drift = object.is_sighted ? std::abs(object.moving.lead().velocity()[axis] - place.v) : 0.0;
    for (std::size_t k = 0; k < ends_.size(); ++k) {
      AxisFilter at = place;
      at.predict((from - state.at + ends_[k]).seconds(), kRestingSigma * kRestingSigma);
      const double unseen_s = (from - object.last_seen + ends_[k]).seconds();
      double apart = std::abs(waypoints[k].centre[axis] - at.x);
      if (object.is_sighted) apart += unnoticed + drift * std::min(unseen_s, kDriftTime);
      for (std::size_t level = 0; level < trusted_s.size(); ++level) {
        double half = rest_quantiles_[is_unseen ? 0 : level] * std::sqrt(at.xx) + apart;
        if (unseen_s > trusted_s[level]) half += unnoticed + speed * (unseen_s - trusted_s[level]);
        waypoints[k].half[level][axis] = std::min(waypoints[k].half[level][axis], half);
      }
    }
  }
}

}  // namespace tern
