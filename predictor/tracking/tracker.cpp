#include "predictor/tracking/tracker.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

#include "predictor/tracking/assignment.h"

namespace tern {
namespace {

constexpr int kNoDetection = -1;

// For each object the index of its detection, and which detections are taken.
struct Matching {
  std::vector<int> detection_of;
  std::vector<bool> taken;
};

std::array<AxisFilter, 3> start_filters(const Detection& detection, double speed_variance) {
  std::array<AxisFilter, 3> axes;
  for (int i = 0; i < 3; ++i) {
    axes[static_cast<std::size_t>(i)] = {detection.position[i], 0.0, std::max(detection.variance[i], kLeastVariance),
                                         0.0, speed_variance};
  }
  return axes;
}

std::array<SingerFilter, 3> with_acceleration(const std::array<AxisFilter, 3>& axes, double sigma) {
  std::array<SingerFilter, 3> result;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const AxisFilter& axis = axes[i];
    result[i].state << axis.x, axis.v, 0.0;
    result[i].covariance << axis.xx, axis.xv, 0.0, axis.xv, axis.vv, 0.0, 0.0, 0.0, sigma * sigma;
  }
  return result;
}

std::array<AxisFilter, 3> without_acceleration(const std::array<SingerFilter, 3>& axes) {
  std::array<AxisFilter, 3> result;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const Eigen::Matrix3d& p = axes[i].covariance;
    result[i] = {axes[i].state[0], axes[i].state[1], p(0, 0), p(0, 1), p(1, 1)};
  }
  return result;
}

template <typename Filter>
void update_axes(std::array<Filter, 3>& axes, const Detection& detection) {
  for (int i = 0; i < 3; ++i) axes[static_cast<std::size_t>(i)].update(detection.position[i], detection.variance[i]);
}

void match_by_id(const std::vector<TrackedObject>& objects, const std::vector<Detection>& detections,
                 Matching& matching) {
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (detections[d].track_id == kNoTrackId) continue;
    const auto object = std::find_if(objects.begin(), objects.end(),
                                     [&](const TrackedObject& o) { return o.id == detections[d].track_id; });
    if (object == objects.end()) continue;
    int& mine = matching.detection_of[static_cast<std::size_t>(object - objects.begin())];
    if (mine != kNoDetection) continue;
    mine = static_cast<int>(d);
    matching.taken[d] = true;
  }
}

// Among objects with the given confirmation, and detections without an id, that are still free.
void match_by_distance(const std::vector<TrackedObject>& objects, const std::vector<Detection>& detections,
                       bool confirmed, Matching& matching) {
  std::vector<std::size_t> rows, columns;
  for (std::size_t o = 0; o < objects.size(); ++o) {
    if (objects[o].confirmed == confirmed && matching.detection_of[o] == kNoDetection) rows.push_back(o);
  }
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (!matching.taken[d] && detections[d].track_id == kNoTrackId) columns.push_back(d);
  }
  Eigen::MatrixXd cost(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns.size()));
  for (Eigen::Index r = 0; r < cost.rows(); ++r) {
    for (Eigen::Index c = 0; c < cost.cols(); ++c) {
      cost(r, c) = mahalanobis2(objects[rows[static_cast<std::size_t>(r)]].moving,
                                detections[columns[static_cast<std::size_t>(c)]]);
    }
  }
  const std::vector<int> column_of = assign(cost, kAssociationGate);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (column_of[r] == kUnassigned) continue;
    const std::size_t d = columns[static_cast<std::size_t>(column_of[r])];
    matching.detection_of[rows[r]] = static_cast<int>(d);
    matching.taken[d] = true;
  }
}

Matching match(const std::vector<TrackedObject>& objects, const std::vector<Detection>& detections) {
  Matching matching{std::vector<int>(objects.size(), kNoDetection), std::vector<bool>(detections.size(), false)};
  match_by_id(objects, detections, matching);
  match_by_distance(objects, detections, true, matching);
  match_by_distance(objects, detections, false, matching);
  return matching;
}

bool is_out_of_range(const TrackedObject& object, const ObservationSet& observations) {
  if (observations.range_m <= 0.0) return false;
  Vec3 away;
  for (int i = 0; i < 3; ++i) {
    const double offset = std::abs(object.resting[static_cast<std::size_t>(i)].x - observations.sensor_position[i]);
    away[i] = std::max(0.0, offset - object.half_extents[i]);
  }
  return away.norm() > observations.range_m - kRangeMargin;
}

std::pair<UTime, std::int32_t> key(const ObservationSet& set) { return {set.at, set.sensor_id}; }

}  // namespace

Taken Tracker::update(const ObservationSet& observations) {
  if (!steps_.empty() && observations.at + kReorderWindow < newest()) return Taken::TooOld;
  const auto place =
      std::lower_bound(steps_.begin(), steps_.end(), observations,
                       [](const Step& a, const ObservationSet& b) { return key(a.observations) < key(b); });
  if (place != steps_.end() && key(place->observations) == key(observations)) return Taken::Repeated;
  auto step = steps_.insert(place, Step{observations, {}});
  for (; step != steps_.end(); ++step) {
    const State& before = step == steps_.begin() ? before_steps_ : (step - 1)->after;
    step->after = advanced(before, step->observations);
  }
  while (steps_.size() > 1 && steps_.front().observations.at + kReorderWindow < newest()) {
    before_steps_ = std::move(steps_.front().after);
    steps_.pop_front();
  }
  return Taken::Yes;
}

Tracker::State Tracker::advanced(State state, const ObservationSet& observations) const {
  const UTime at = observations.at;
  predict_to(state, at);
  for (TrackedObject& object : state.objects) {
    if (at - object.last_seen > config_.coast && rests(object)) {
      // Remembered: what is found there again belongs to it, not whatever a mover could have become.
      object.moving = with_acceleration(object.resting, 0.0);
    }
  }
  const std::vector<Detection>& detections = observations.detections;
  const Matching matching = match(state.objects, detections);
  for (std::size_t o = 0; o < state.objects.size(); ++o) {
    TrackedObject& object = state.objects[o];
    const int d = matching.detection_of[o];
    if (d != kNoDetection || object.last_seen_by == observations.sensor_id) {
      ++object.age;
      object.hits <<= 1;
    }
    if (d != kNoDetection) take(object, detections[static_cast<std::size_t>(d)], observations, state.rest);
    object.confirmed = object.confirmed || std::popcount(object.hits) >= config_.confirm_hits;
  }
  std::erase_if(state.objects, [&](const TrackedObject& object) { return is_dead(object, observations); });
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (matching.taken[d]) continue;
    const std::int64_t given = detections[d].track_id;
    const bool known = given != kNoTrackId && std::any_of(state.objects.begin(), state.objects.end(),
                                                          [&](const TrackedObject& o) { return o.id == given; });
    if (known) continue;
    const std::int64_t id = given == kNoTrackId ? state.next_id++ : given;
    state.objects.push_back(born(detections[d], observations, id));
  }
  std::sort(state.objects.begin(), state.objects.end(),
            [](const TrackedObject& a, const TrackedObject& b) { return a.id < b.id; });
  return state;
}

void Tracker::predict_to(State& state, UTime at) const {
  const double dt = state.objects.empty() ? 0.0 : (at - state.at).seconds();
  const Transition step = transition(config_.acceleration, dt);
  for (TrackedObject& object : state.objects) {
    for (SingerFilter& axis : object.moving) axis.predict(step);
    for (AxisFilter& axis : object.resting) axis.predict(dt, kRestingSigma * kRestingSigma);
  }
  state.at = at;
}

void Tracker::take(TrackedObject& object, const Detection& detection, const ObservationSet& from,
                   RestRecord& rest) const {
  const bool rested = object.confirmed && rests(object);
  const UTime seen = object.last_seen;
  const std::array<AxisFilter, 3> stood = object.resting;
  take(object, detection, from);
  if (rested && object.resting_since == from.at) {
    object.stood = stood;
    // It may go at any speed now, as what is seen for the first time.
    object.moving = born(detection, from, object.id).moving;
  } else if (rested) {
    rest.rested_s += (from.at - seen).seconds();
    object.stood.reset();
  } else if (object.stood && mahalanobis2(*object.stood, detection) > kJumpGate) {
    ++rest.starts;
    object.stood.reset();
  }
}

void Tracker::take(TrackedObject& object, const Detection& detection, const ObservationSet& from) const {
  const double distance2 = mahalanobis2(object.moving, detection);
  if (distance2 > kJumpGate) {
    const TrackedObject anew = born(detection, from, object.id);
    object.moving = anew.moving;
    object.resting = anew.resting;
    object.resting_since = from.at;
    object.resting_average = anew.resting_average;
  } else {
    const double resting2 = mahalanobis2(object.resting, detection);
    object.resting_average += kRestingForgetting * (resting2 - object.resting_average);
    update_axes(object.moving, detection);
    update_axes(object.resting, detection);
    if (object.resting_average > kRestingLimit) {
      object.resting = without_acceleration(object.moving);
      object.resting_since = from.at;
      object.resting_average = 3.0;
    }
  }
  const Vec3 shrunk = object.half_extents + kExtentShrink * (detection.half_extents - object.half_extents);
  object.half_extents = shrunk.cwiseMax(detection.half_extents);
  object.last_seen = from.at;
  object.last_seen_by = from.sensor_id;
  object.hits |= 1u;
}

TrackedObject Tracker::born(const Detection& detection, const ObservationSet& from, std::int64_t id) const {
  TrackedObject object;
  object.id = id;
  object.last_seen = from.at;
  object.last_seen_by = from.sensor_id;
  object.resting_since = from.at;
  object.half_extents = detection.half_extents;
  const double speed = config_.prediction.speed_deviation();
  object.resting = start_filters(detection, speed * speed);
  const AccelerationModel& model = config_.acceleration;
  object.moving = with_acceleration(object.resting, model.time_s > 0.0 ? model.sigma : 0.0);
  object.confirmed = config_.confirm_hits <= 1;
  return object;
}

bool Tracker::is_dead(const TrackedObject& object, const ObservationSet& observations) const {
  const Duration unseen = observations.at - object.last_seen;
  const bool can_miss = object.last_seen_by == observations.sensor_id;
  if (!object.confirmed) return can_miss ? object.age >= config_.confirm_window : unseen > kTentativeUnseen;
  if (unseen <= config_.coast) return false;
  const bool is_missed = can_miss && !(rests(object) && is_out_of_range(object, observations));
  return is_missed || unseen > config_.remember_rest;
}

bool Tracker::rests(const TrackedObject& object) const {
  if (object.last_seen - object.resting_since < config_.resting_after) return false;
  return std::all_of(object.resting.begin(), object.resting.end(), [](const AxisFilter& axis) {
    return std::abs(axis.v) <= std::max(kRestingSpeed, kRestingSpeedSigmas * std::sqrt(axis.vv));
  });
}

PredictionSpec Tracker::rest_spec() const {
  PredictionSpec spec = config_.prediction;
  spec.confidence += kStartShare * (1.0 - spec.confidence);
  return spec;
}

const StartSpread& Tracker::spread_of(const TrackedObject& object, const State& state, Spreads& spreads) const {
  const double trusted_s = trusted_rest_s(state.rest, kStartShare * (1.0 - config_.prediction.confidence));
  const double still_s = std::min(trusted_s - (state.at - object.last_seen).seconds(), rest_spec().horizon.seconds());
  const auto grid = static_cast<std::int64_t>(std::floor(still_s / kStartGrid));
  const auto found = spreads.find(grid);
  if (found != spreads.end()) return found->second;
  const double from_s = kStartGrid * static_cast<double>(grid);
  return spreads.emplace(grid, start_spread(from_s, config_.acceleration, rest_spec())).first->second;
}

void Tracker::predict_resting(const TrackedObject& object, UTime at, const StartSpread& start, Track& track) const {
  const PredictionSpec spec = rest_spec();
  std::array<AxisForecast, 3> axes;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    axes[i] = forecast_of_rest(object.resting[i], kRestingSigma * kRestingSigma, start, spec);
  }
  predict_motion(axes, at, spec, track);
}

std::vector<Track> Tracker::predict(UTime now) const {
  State state = newest_state();
  predict_to(state, std::max(now, state.at));
  Spreads spreads;
  std::vector<Track> tracks;
  for (const TrackedObject& object : state.objects) {
    if (!object.confirmed) continue;
    Track track;
    track.id = object.id;
    track.kind = TrackKind::Estimated;
    track.half_extents = object.half_extents;
    if (rests(object)) {
      predict_resting(object, state.at, spread_of(object, state, spreads), track);
    } else {
      std::array<AxisForecast, 3> axes;
      for (std::size_t i = 0; i < axes.size(); ++i) axes[i] = forecaster_.forecast(object.moving[i]);
      predict_motion(axes, state.at, config_.prediction, track);
    }
    tracks.push_back(std::move(track));
  }
  return tracks;
}

}  // namespace tern
