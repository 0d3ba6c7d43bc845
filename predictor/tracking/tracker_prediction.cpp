// Tracker's predictions. Steps 9 and 10 of docs/prediction.md.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "predictor/tracking/sensor_range.h"
#include "predictor/tracking/tracker.h"

namespace tern {
namespace {

// How long before its last detection a track had its last position, s per axis. Out of sight the longest counts for
// all axes: what was seen last may have been another obstacle.
Vec3 unlocated_for(const TrackedObject& object, bool is_unseen) {
  if (!object.is_sighted) return Vec3::Zero();
  Vec3 before;
  for (int axis = 0; axis < 3; ++axis) before[axis] = (object.last_seen - object.located_at[idx(axis)]).seconds();
  return is_unseen ? Vec3::Constant(before.maxCoeff()) : before;
}

// The half-width at ahead_s after the last detection, by the time since the last position on each axis.
Vec3 half_width(const MixturePrediction& mixture, const PerBand<double>& margins, double ahead_s,
                const Vec3& unlocated_s) {
  Vec3 half = interval_half_width(mixture.deviation, margins, ahead_s);
  for (int axis = 0; axis < 3; ++axis) {
    if (unlocated_s[axis] > 0.0)
      half[axis] = interval_half_width(mixture.deviation, margins, ahead_s + unlocated_s[axis])[axis];
  }
  return half;
}

}  // namespace

bool Tracker::is_published(const TrackedObject& object, const ExistenceRecord& existence) const {
  if (object.confirmed) return true;
  if (object.is_doubtful) return false;
  if (object.detections > 1) return true;
  return object.age <= kMissesToHide && existence.real_share() > 1.0 - config_.prediction.confidence;
}

std::int32_t Tracker::left_out() const {
  std::int32_t sum = 0;
  for (const SensorRecord& view : newest_state().views) {
    if (view.at + kReorderWindow >= newest()) sum += view.left_out;
  }
  return sum;
}

double Tracker::top_speed() const { return std::max(config_.prediction.max_speed, scorer_.speeds().max_axis_speed()); }

std::pair<Waypoint, Vec3> Tracker::resting_at(const TrackedObject& object, const State& state, UTime from,
                                              double ahead_s) const {
  const double to_s = (from - state.at).seconds() + ahead_s;
  const double unseen_s = (from - object.last_seen).seconds() + ahead_s;
  Waypoint waypoint;
  Vec3 sigma, unnoticed, drift = Vec3::Zero();
  const Vec3 velocity = object.moving.lead().velocity();
  for (int axis = 0; axis < 3; ++axis) {
    AxisFilter at = object.resting[static_cast<std::size_t>(axis)];
    unnoticed[axis] = std::abs(object.position[axis] - at.x);
    at.predict(to_s, kRestingSigma * kRestingSigma);
    waypoint.centre[axis] = at.x;
    waypoint.velocity[axis] = at.v;
    sigma[axis] = std::sqrt(at.xx);
    if (object.is_sighted)
      drift[axis] = unnoticed[axis] + std::abs(velocity[axis] - at.v) * std::min(unseen_s, kDriftTime);
  }
  for (std::size_t level = 0; level < waypoint.half.size(); ++level) {
    const double missed = 1.0 - confidence_at(config_.prediction.confidence, static_cast<int>(level));
    const double moved_s = std::max(0.0, unseen_s - trusted_rest_s(state.rest, kStartShare * missed));
    waypoint.half[level] = rest_quantiles_[level] * sigma + drift;
    if (moved_s > 0.0) waypoint.half[level] += unnoticed + Vec3::Constant(top_speed() * moved_s);
  }
  return {waypoint, rest_quantiles_.front() * sigma + drift};
}

Tracker::Forecast Tracker::at_rest(const TrackedObject& object, const State& state, UTime from) const {
  Forecast forecast;
  TrackBound& bound = forecast.bound;
  for (std::size_t k = 0; k < ends_.size(); ++k) {
    const auto [waypoint, model] = resting_at(object, state, from, ends_[k].seconds());
    forecast.waypoints.push_back(waypoint);
    if (k == bound_at_) bound.model = model.maxCoeff();
  }
  bound.kind = MotionKind::Resting;
  bound.evidence = state.rest.starts;
  const bool may_have_gone = forecast.waypoints[bound_at_].half.front().maxCoeff() > bound.model;
  bound.ruled_by = may_have_gone ? BoundRule::Reach : BoundRule::Model;
  return forecast;
}

const std::vector<LearntCoefficients>& Tracker::learnt_coefficients(std::size_t group, UTime last_seen,
                                                                    PredictionInputs& inputs) const {
  std::vector<LearntCoefficients>& coefficients = inputs.learnt[{group, last_seen}];
  if (!coefficients.empty()) return coefficients;
  for (const Duration end : ends_) {
    coefficients.push_back(scorer_.learnt().at((inputs.from - last_seen + end).seconds(), group));
  }
  return coefficients;
}

Tracker::Forecast Tracker::moving(const TrackedObject& object, PredictionInputs& inputs) const {
  const PredictionScorer::Assessment assessment = this->assessment(object);
  const bool is_sure = object.confirmed || object.detections > 1;
  const Calibration& calibration = scorer_.calibration(is_coarse(object));
  const PerLevel& margins = is_sure ? calibration.margins(assessment.of) : inputs.unsure_margins;
  const double since_s = (inputs.from - object.last_seen).seconds();
  const bool is_unseen = since_s > kUnseenAfter;
  const Vec3 unlocated_s = unlocated_for(object, is_unseen);
  Forecast forecast{std::vector<Waypoint>(ends_.size()), {}};
  for (std::size_t k = 0; k < ends_.size(); ++k) {
    Waypoint& waypoint = forecast.waypoints[k];
    const double ahead_s = since_s + ends_[k].seconds();
    const PerCandidate<double> weights = weights_at(assessment.weights, ahead_s);
    FilterPrediction learnt;
    if (weights[kLearnt] > 0.0) {
      learnt =
          learnt_prediction(learnt_coefficients(*assessment.group, object.last_seen, inputs)[k], object.learnt_input);
    }
    const MixturePrediction mixture = mixture_prediction(object.moving, inputs.rows[k], learnt, weights);
    waypoint.centre = mixture.centre;
    waypoint.velocity = mixture.velocity;
    if (k == bound_at_) forecast.bound.model = model_sigmas_ * mixture.deviation.maxCoeff();
    for (std::size_t level = 0; level < margins.size(); ++level) {
      waypoint.half[level] = half_width(mixture, margins[is_unseen ? 0 : level], ahead_s, unlocated_s);
    }
  }
  TrackBound& bound = forecast.bound;
  bound.kind = assessment.of.motion;
  bound.evidence = calibration.evidence(assessment.of, band_of(since_s + ends_[bound_at_].seconds()));
  bound.ruled_by = bound.evidence < Calibration::kPriorWeight ? BoundRule::Prior : BoundRule::Measured;
  return forecast;
}

bool Tracker::has_left_range(const TrackedObject& object, const std::vector<SensorRecord>& views,
                             const Waypoint& start) {
  if (start.half.front().maxCoeff() <= kMaxUnseenAlpha) return false;
  return std::ranges::any_of(views, [&](const SensorRecord& view) {
    return view.sensor_id == object.last_seen_by && object.last_seen < view.at &&
           is_beyond_range(view.range_m, view.from, start.centre, object.half_extents);
  });
}

bool Tracker::is_handed_over(const TrackedObject& object, const Box& box, UTime from, const Waypoint& start) {
  if ((from - object.last_seen).seconds() <= kUnseenAfter) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = std::max(kMaxUnseenAlpha, box.sizes()[axis]);
    const bool is_asked = object.faces.has_position(axis) || object.faces.positions() < kAxesToRest;
    if (is_asked && start.half.front()[axis] > size) return true;
  }
  return false;
}

void Tracker::predict(const TrackedObject& object, PredictionInputs& inputs, std::vector<Track>& tracks,
                      std::vector<TrackBound>* why) const {
  const State& newest = newest_state();
  if (!is_published(object, newest.existence)) return;
  const bool is_resting = is_stationary(object);
  auto [waypoints, bound] = is_resting ? at_rest(object, newest, inputs.from) : moving(object, inputs);
  if (!is_resting) narrow_resting_axes(object, newest, inputs.from, waypoints);
  Track track;
  if (object.is_sighted) {
    const Box least = object.faces.completed(Vec3::Zero(), kReachSigmas);
    if (is_handed_over(object, least, inputs.from, waypoints.front())) return;
    const Box box = object.faces.whole(Vec3::Zero(), kReachSigmas, newest.sizes);
    for (Waypoint& waypoint : waypoints) waypoint.centre += box.center();
    track.half_extents = 0.5 * box.sizes();
  } else {
    if (has_left_range(object, newest.views, waypoints.front())) return;
    track.half_extents = object.half_extents;
  }
  const double seen_speed = is_resting ? 0.0 : waypoints.front().velocity.cwiseAbs().maxCoeff();
  track.id = object.id;
  track.kind = TrackKind::Estimated;
  set_motion(waypoints, ends_, inputs.from, std::max(top_speed(), seen_speed), track);
  if (why != nullptr) {
    bound.id = object.id;
    bound.ahead_s = ends_[bound_at_].seconds();
    bound.measured = waypoints[bound_at_].half.front().maxCoeff();
    bound.promised = track.alpha[bound_at_ - 1].maxCoeff();
    if (bound.promised < bound.measured) bound.ruled_by = BoundRule::Reach;
    why->push_back(bound);
  }
  tracks.push_back(std::move(track));
}

std::vector<Track> Tracker::predict(UTime now, std::vector<TrackBound>* why) const {
  const State& newest = newest_state();
  const UTime from = std::max(now, newest.at);
  const BankStep first = bank_step((from - newest.at).seconds());
  PredictionInputs inputs{from, scorer_.calibration().margins(kNewTrack, newest.existence.real_share()), {}, {}};
  for (const BankStep& step : steps_ahead_) inputs.rows.push_back(bank_output_rows(step, first));
  std::vector<Track> tracks;
  for (const TrackedObject& object : newest.objects) predict(object, inputs, tracks, why);
  for (const TrackedObject& object : newest.sighted) predict(object, inputs, tracks, why);
  if (!newest.sighted.empty()) {
    std::ranges::sort(tracks, {}, &Track::id);
    if (why != nullptr) std::ranges::sort(*why, {}, &TrackBound::id);
  }
  return tracks;
}

}  // namespace tern
