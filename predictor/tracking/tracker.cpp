#include "predictor/tracking/tracker.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "predictor/tracking/matching.h"
#include "predictor/tracking/resting_filters.h"
#include "predictor/tracking/sensor_range.h"
#include "predictor/tracking/track_bound.h"

namespace tern {
namespace {

// The cost that different sizes add to a match.
double size_cost(const Vec3& half, const Detection& detection) {
  const double scale = std::max(half.maxCoeff(), detection.half_extents.maxCoeff());
  const Vec3 variance = 2.0 * detection.variance + Vec3::Constant(std::pow(kSizeShare * scale, 2) + kMinVariance);
  return std::min(kMaxSizeCost, (half - detection.half_extents).cwiseAbs2().cwiseQuotient(variance).sum());
}

bool is_out_of_range(const TrackedObject& object, const ObservationSet& observations) {
  return is_beyond_range(observations.range_m, observations.sensor_position, position(object.resting),
                         object.half_extents);
}

void restart(TrackedObject& object, const Detection& detection, const ObservationSet& from) {
  object.moving = BankFilter(detection.position, detection.variance);
  object.born = from.at;
  object.detections = 1;
}

// True if a track that rested is detected elsewhere. Faces of one obstacle may be taken for each other, so a track by
// sightings has to go farther.
bool has_left(const TrackedObject& object, const std::array<AxisFilter, 3>& stood, const Detection& detection) {
  if (fit_of(stood, detection).distance2 <= kJumpGate) return false;
  return !object.is_sighted || (detection.position - position(stood)).norm() > kSightedStart;
}

// True if a track by sightings, which rested at `stood`, rests at another place: a start that ended within
// kSightedStart.
bool rests_elsewhere(const TrackedObject& object, const std::array<AxisFilter, 3>& stood) {
  return object.is_sighted && (position(object.resting) - position(stood)).norm() > kFaceGate;
}

std::pair<UTime, std::int32_t> key(const ObservationSet& set) { return {set.at, set.sensor_id}; }

}  // namespace

Tracker::Tracker(const TrackerConfig& config)
    : config_(config), ends_(piece_ends(config.prediction)), scorer_(config.prediction.confidence, config.learns) {
  for (const Duration end : ends_) steps_ahead_.push_back(bank_step(end.seconds()));
  bound_at_ = idx(std::ranges::lower_bound(ends_, std::min(kBoundsAhead, ends_.back())) - ends_.begin());
  model_sigmas_ = escape_quantile(1.0 - config.prediction.confidence, 0.0);
  for (std::size_t level = 0; level < rest_quantiles_.size(); ++level) {
    const double missed = 1.0 - confidence_at(config.prediction.confidence, static_cast<int>(level));
    rest_quantiles_[level] = escape_quantile((1.0 - kStartShare) * missed / 3.0, kRestCrossings);
  }
}

UpdateOutcome Tracker::update(const ObservationSet& observations, const Vec3& vehicle) {
  return insert({observations, nullptr, vehicle, {}});
}

UpdateOutcome Tracker::insert(Step taken) {
  const ObservationSet& observations = taken.observations;
  if (!steps_.empty() && observations.at + kReorderWindow < newest()) return UpdateOutcome::TooOld;
  const auto place =
      std::ranges::lower_bound(steps_, key(observations), {}, [](const Step& a) { return key(a.observations); });
  if (place != steps_.end() && key(place->observations) == key(observations)) return UpdateOutcome::Repeated;
  const State& state = newest_state();
  const auto later = static_cast<std::size_t>(steps_.end() - place);
  if (later * (1 + state.objects.size() + state.sighted.size()) > kMaxReplayed) return UpdateOutcome::TooCostly;
  taken.after = std::move(spare_);
  auto step = steps_.insert(place, std::move(taken));
  for (; step != steps_.end(); ++step) {
    step->after = step == steps_.begin() ? before_steps_ : (step - 1)->after;
    advance(step->after, *step);
  }
  while (steps_.size() > 1 && steps_.front().observations.at + kReorderWindow < newest()) {
    settle(steps_.front());
    spare_ = std::exchange(before_steps_, std::move(steps_.front().after));
    steps_.pop_front();
  }
  return UpdateOutcome::Used;
}

void Tracker::note_view(State& state, const SensorRecord& view) {
  std::erase_if(state.views, [&](const SensorRecord& record) { return record.sensor_id == view.sensor_id; });
  if (state.views.size() >= kMaxSensors) state.views.erase(state.views.begin());
  state.views.push_back(view);
}

void Tracker::advance(State& state, const Step& step) const {
  if (step.sightings) {
    advance(state, *step.sightings, step.vehicle);
  } else {
    advance(state, step.observations, step.vehicle);
  }
}

void Tracker::advance(State& state, const ObservationSet& observations, const Vec3& vehicle) const {
  const UTime at = observations.at;
  note_view(state, {observations.sensor_id, at, observations.range_m, observations.sensor_position, 0});
  predict_to(state, at);
  const std::vector<Detection>& detections = observations.detections;
  const Matching matching = match(
      state.objects, detections,
      [&](const TrackedObject& object, const Detection& detection) { return match_cost(object, at, detection); },
      [&](const TrackedObject& object, const Vec3& variance) { return gate_box(object, at, variance); });
  for (std::size_t o = 0; o < state.objects.size(); ++o) {
    TrackedObject& object = state.objects[o];
    const int d = matching.detection_of[o];
    if (d != kNoDetection || object.last_seen_by == observations.sensor_id) {
      ++object.age;
      object.hits <<= 1;
    }
    if (d != kNoDetection) {
      if (object.detections == 1 && !object.confirmed) ++state.existence.again;
      update_track(object, detections[static_cast<std::size_t>(d)], observations, state);
    }
    object.confirmed = object.confirmed || std::popcount(object.hits) >= config_.confirm_hits;
  }
  std::erase_if(state.objects, [&](const TrackedObject& object) {
    const bool dead = is_expired(object, observations);
    if (dead && object.detections == 1 && !object.confirmed) ++state.existence.never;
    return dead;
  });
  const std::vector<TrackedObject>& known = state.objects;
  std::vector<TrackedObject> started;
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (matching.taken[d]) continue;
    const std::int64_t given = detections[d].track_id;
    if (given != kNoTrackId && std::ranges::binary_search(known, given, {}, &TrackedObject::id)) continue;
    started.push_back(start_track(detections[d], observations, given == kNoTrackId ? state.next_id++ : given));
  }
  std::ranges::move(started, std::back_inserter(state.objects));
  // Objects are large: those that ascend already are not moved.
  if (!std::ranges::is_sorted(state.objects, {}, &TrackedObject::id)) {
    std::ranges::sort(state.objects, {}, &TrackedObject::id);
  }
  constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
  state.views.back().left_out = bound_tracks(state.objects, 0, kFirstOwnTrackId, kMaxNamedTracks, vehicle, at) +
                                bound_tracks(state.objects, kFirstOwnTrackId, kLast, kMaxAnonymousTracks, vehicle, at);
}

void Tracker::predict_to(State& state, UTime at) const {
  const double dt = state.objects.empty() && state.sighted.empty() ? 0.0 : (at - state.at).seconds();
  const BankStep step = bank_step(dt);
  for (std::vector<TrackedObject>* objects : {&state.objects, &state.sighted}) {
    for (TrackedObject& object : *objects) {
      object.moving.predict(step);
      for (AxisFilter& axis : object.resting) axis.predict(dt, kRestingSigma * kRestingSigma);
      for (AxisRest& axis : object.rest_of_axes) axis.filter.predict(dt, kRestingSigma * kRestingSigma);
    }
  }
  state.at = at;
}

void Tracker::update_track(TrackedObject& object, const Detection& detection, const ObservationSet& from,
                           State& state) const {
  RestRecord& rest = state.rest;
  const bool rested = object.confirmed && is_stationary(object);
  const UTime seen = object.last_seen;
  const std::array<AxisFilter, 3> stood = object.resting;
  update_track(object, detection, from);
  update_rest_of_axes(object, detection, from.at, seen, state.rest_of_axes);
  if (rested && object.resting_since == from.at) {
    object.stood = stood;
    // Its new speed is as unknown as that of a new track.
    restart(object, detection, from);
  } else if (rested) {
    rest.rested_s += (from.at - seen).seconds();
    if (object.stood && rests_elsewhere(object, *object.stood)) ++rest.starts;
    object.stood.reset();
  } else if (object.stood && has_left(object, *object.stood, detection)) {
    // A detection at the old place means that the obstacle still rests there, and that this is another one.
    if (!is_seen_at(*object.stood, from)) ++rest.starts;
    object.stood.reset();
  }
}

void Tracker::update_track(TrackedObject& object, const Detection& detection, const ObservationSet& from) const {
  if (may_be_another(object, from.at) || object.moving.distance2(detection.position, detection.variance) > kJumpGate) {
    const TrackedObject anew = start_track(detection, from, object.id);
    restart(object, detection, from);
    object.resting = anew.resting;
    object.resting_since = from.at;
    object.resting_average = anew.resting_average;
  } else {
    const double resting2 = fit_of(object.resting, detection).distance2;
    object.resting_average += kRestingForgetting * (resting2 - object.resting_average);
    object.moving.update(detection.position, detection.variance);
    if (config_.learns) object.learnt_input = learnt_input(object.moving);
    ++object.detections;
    update_axes(object.resting, detection);
    if (object.resting_average > kRestingLimit) {
      for (int axis = 0; axis < 3; ++axis) {
        object.resting[static_cast<std::size_t>(axis)] = object.moving.lead().marginal(axis);
      }
      object.resting_since = from.at;
      object.resting_average = 3.0;
    }
  }
  const Vec3 shrunk = object.half_extents + kExtentShrink * (detection.half_extents - object.half_extents);
  object.half_extents = shrunk.cwiseMax(detection.half_extents);
  object.position = detection.position;
  object.variance = detection.variance;
  object.last_seen = from.at;
  object.last_seen_by = from.sensor_id;
  object.hits |= 1u;
}

TrackedObject Tracker::start_track(const Detection& detection, const ObservationSet& from, std::int64_t id) const {
  TrackedObject object;
  object.id = id;
  object.last_seen = from.at;
  object.last_seen_by = from.sensor_id;
  object.resting_since = from.at;
  object.half_extents = detection.half_extents;
  object.position = detection.position;
  object.variance = detection.variance;
  const double speed = config_.prediction.max_speed;
  object.resting = start_filters(detection, speed * speed / 3.0);  // uniform in ±speed
  for (int axis = 0; axis < 3; ++axis) object.rest_of_axes[idx(axis)] = {object.resting[idx(axis)], from.at, 1.0, {}};
  restart(object, detection, from);
  object.confirmed = config_.confirm_hits <= 1;
  return object;
}

bool Tracker::is_expired(const TrackedObject& object, const ObservationSet& observations) const {
  const Duration unseen = observations.at - object.last_seen;
  const bool can_miss = object.last_seen_by == observations.sensor_id;
  if (!object.confirmed) return can_miss ? object.age >= config_.confirm_window : unseen > kTentativeUnseen;
  if (unseen <= config_.coast) return false;
  const bool is_missed = can_miss && !(is_stationary(object) && is_out_of_range(object, observations));
  return is_missed || unseen > config_.remember_rest;
}

bool Tracker::may_be_another(const TrackedObject& object, UTime at) const {
  return (at - object.last_seen).seconds() > kUnseenAfter && std::countr_zero(object.hits) > kMissesToRestart &&
         !is_stationary(object);
}

bool Tracker::is_stationary(const TrackedObject& object) const {
  if (object.last_seen - object.resting_since < config_.resting_after) return false;
  if (object.is_sighted) {
    const bool is_sound = object.rejected == std::array<int, 3>{};
    return is_sound && object.faces.positions() >= kAxesToRest && object.is_rest_known;
  }
  return std::ranges::all_of(object.resting, is_slow);
}

bool Tracker::is_remembered(const TrackedObject& object, UTime at) const {
  return at - object.last_seen > config_.coast && is_stationary(object);
}

double Tracker::match_cost(const TrackedObject& object, UTime at, const Detection& detection) const {
  constexpr double kBeyond = std::numeric_limits<double>::infinity();
  double of_place = kBeyond;
  if (is_remembered(object, at)) {
    const Fit fit = fit_of(object.resting, detection);
    if (fit.distance2 <= kAssociationGate) of_place = fit.neg_log_likelihood();
  } else {
    of_place = object.moving.cost_within(kAssociationGate, detection.position, detection.variance);
  }
  return of_place < kBeyond ? of_place + size_cost(object.half_extents, detection) : kBeyond;
}

Box Tracker::gate_box(const TrackedObject& object, UTime at, const Vec3& variance) const {
  if (!is_remembered(object, at)) return object.moving.gate_box(kAssociationGate, variance);
  const auto& [x, y, z] = object.resting;
  return tern::gate_box({x.x, y.x, z.x}, {x.xx, y.xx, z.xx}, kAssociationGate, variance);
}

DetectedTrack Tracker::detected_track(const TrackedObject& object) const {
  return {object.id,      object.born,           object.detections, object.position,  object.variance,
          &object.moving, is_stationary(object), is_coarse(object), object.is_sighted};
}

void Tracker::settle(const Step& step) {
  const ObservationSet& from = step.observations;
  std::vector<DetectedTrack> detected;
  std::set<std::int64_t> all;
  for (const std::vector<TrackedObject>* objects : {&step.after.objects, &step.after.sighted}) {
    for (const TrackedObject& object : *objects) {
      all.insert(object.id);
      if (object.last_seen == from.at && object.last_seen_by == from.sensor_id && object.is_located)
        detected.push_back(detected_track(object));
    }
  }
  if (!step.after.sighted.empty()) std::ranges::sort(detected, {}, &DetectedTrack::id);
  scorer_.update(from.at, detected, all);
}

PredictionScorer::Assessment Tracker::assessment(const TrackedObject& object) const {
  return scorer_.assessment(detected_track(object), object.last_seen);
}

}  // namespace tern
