// Tracker's tracks by sightings. docs/prediction/faces.md.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>

#include "predictor/faces/frame_error.h"
#include "predictor/faces/looked_for.h"
#include "predictor/faces/open_ends.h"
#include "predictor/faces/sighting_matching.h"
#include "predictor/tracking/resting_filters.h"
#include "predictor/tracking/track_bound.h"
#include "predictor/tracking/tracker.h"

namespace tern {
namespace {

// A sensor's velocity is taken from its newest two frames if they are at most this far apart.
constexpr Duration kVelocitySpan{500'000};

// The largest standard deviation of a mover's anchor, on an axis with a position, m.
double place_sigma(const TrackedObject& object) {
  const Vec3 variance = object.moving.lead().variance();
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    if (object.faces.has_position(axis)) largest = std::max(largest, variance[axis]);
  }
  return std::sqrt(largest);
}

// So it is published, however much α has grown.
bool is_seen_lately(const TrackedObject& object, UTime at) { return (at - object.last_seen).seconds() <= kUnseenAfter; }

Vec3 middle(const Sighting& sighting) { return 0.5 * (sighting.lower + sighting.upper); }

Box visible_part(const Sighting& sighting) { return {sighting.lower, sighting.upper}; }

// The parts of a frame that the filters need.
ObservationSet without_detections(const SightingSet& frame) {
  ObservationSet set;
  set.header = frame.header;
  set.at = frame.at;
  set.sensor_id = frame.sensor_id;
  set.range_m = frame.view.range_m;
  set.sensor_position = frame.view.sensor_position;
  return set;
}

bool contains(const std::vector<Box>& boxes, const Box& piece) {
  return std::ranges::any_of(boxes, [&](const Box& box) { return box.contains(piece); });
}

bool meets(const std::vector<Box>& boxes, const Box& piece) {
  return std::ranges::any_of(boxes, [&](const Box& box) { return box.intersects(piece); });
}

// True if each of 27 points of the piece lies in one of the boxes: it is a part of one, or a cluster of several.
bool is_covered(const std::vector<Box>& boxes, const Box& piece) {
  for (int k = 0; k < 27; ++k) {
    const Eigen::Vector3i halves(k % 3, k / 3 % 3, k / 9);
    const Vec3 p = piece.min() + 0.5 * halves.cast<double>().cwiseProduct(piece.sizes());
    if (std::ranges::none_of(boxes, [&](const Box& box) { return box.contains(p); })) return false;
  }
  return true;
}

// The variance of an anchor, m². Axes share their covariances, and so most of the work, while their variances are
// equal: those that are nearly so are taken as equal.
Vec3 variance_of(const AnchorMeasurement& measured, double common) {
  constexpr double kNearlyEqual = 2.0;
  double least = kNoPosition, most = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!measured.has[idx(axis)]) continue;
    least = std::min(least, common + measured.variance[axis]);
    most = std::max(most, common + measured.variance[axis]);
  }
  Vec3 variance = Vec3::Constant(kNoPosition);
  for (int axis = 0; axis < 3; ++axis) {
    if (measured.has[idx(axis)]) variance[axis] = most < kNearlyEqual * least ? most : common + measured.variance[axis];
  }
  return variance;
}

// Removes the outliers of a measurement (kFaceOutlier). @return per axis: whether it had none
std::array<bool, 3> reject_outliers(TrackedObject& object, const Vec3& predicted, const Sighting& sighting,
                                    AnchorMeasurement& measured) {
  const Vec3 variance = object.moving.lead().variance();
  std::array<bool, 3> is_sound{true, true, true};
  for (int axis = 0; axis < 3; ++axis) {
    if (!measured.has[idx(axis)]) continue;
    const double sigma = std::sqrt(variance[axis] + measured.variance[axis]);
    const double away = std::abs(measured.position[axis] - predicted[axis]);
    is_sound[idx(axis)] = away <= kFaceOutlier + kFaceOutlierSigmas * sigma;
    measured.has[idx(axis)] = is_sound[idx(axis)];
    int& rejected = object.rejected[idx(axis)];
    rejected = is_sound[idx(axis)] ? 0 : rejected + 1;
    if (rejected <= kMostRejected) continue;
    object.faces.relearn(axis, predicted, sighting);
    rejected = 0;
  }
  return is_sound;
}

}  // namespace

UpdateOutcome Tracker::update(const SightingSet& sightings, const Vec3& vehicle) {
  auto frame = std::make_shared<SightingSet>(sightings);
  std::ranges::transform(frame->sightings, frame->sightings.begin(), without_false_ends);
  return insert({without_detections(sightings), std::move(frame), vehicle, {}});
}

Vec3 Tracker::anchor(const TrackedObject& object) const {
  return is_stationary(object) ? position(object.resting) : object.moving.lead().position();
}

TrackedObject Tracker::start_faces(const Sighting& sighting, double common, const ObservationSet& from,
                                   std::int64_t id) const {
  Vec3 anchor;
  const FaceBox faces(sighting, anchor);
  // The anchor is by definition here; only the frame's own error is unknown.
  TrackedObject object = start_track({anchor, {}, Vec3::Constant(common), kNoTrackId}, from, id);
  object.is_sighted = true;
  object.points = sighting.points;
  object.faces = faces;
  object.half_extents = 0.5 * faces.completed(anchor).sizes();
  object.is_located = faces.positions() == 3;
  object.located_at.fill(from.at);
  return object;
}

void Tracker::update_faces(TrackedObject& object, const Sighting& sighting, double common, const ObservationSet& from,
                           State& state) const {
  const Vec3 predicted = anchor(object);
  object.points = std::max(sighting.points, object.points * 7 / 8);
  AnchorMeasurement measured = object.faces.measure(predicted, sighting);
  const std::array<bool, 3> is_sound = reject_outliers(object, predicted, sighting, measured);
  Detection detection{predicted, {}, variance_of(measured, common), kNoTrackId};
  object.is_located = true;
  const auto forget = [&](int axis) {
    object.moving.restart_axis(axis, predicted[axis], common);
    object.resting[idx(axis)] = {predicted[axis], 0.0, common, 0.0, kRestingSpeed * kRestingSpeed};
    object.rest_of_axes[idx(axis)] = {object.resting[idx(axis)], from.at, 1.0, {}};
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (measured.has[idx(axis)]) {
      detection.position[axis] = measured.position[axis];
      object.located_at[idx(axis)] = from.at;
      continue;
    }
    object.is_located = false;
    if (!object.faces.has_position(axis)) forget(axis);
  }
  detection.half_extents = object.half_extents;
  update_track(object, detection, from, state);
  for (int axis = 0; axis < 3; ++axis) {
    if (object.born == from.at && !measured.has[idx(axis)]) forget(axis);  // it was restarted, at no place
  }
  object.is_rest_known = std::ranges::all_of(
      object.resting, [](const AxisFilter& axis) { return std::abs(axis.v) + 2.0 * std::sqrt(axis.vv) <= kKnownRest; });
  const Vec3 now = object.moving.lead().position();
  const bool rests = is_stationary(object);  // so its anchor stays on all axes, and with it what was seen of it
  for (int axis = 0; axis < 3; ++axis) {
    if (!rests && !object.faces.has_position(axis)) object.faces.relearn(axis, now, sighting);
  }
  object.faces.learn(now, sighting, is_sound);
  object.half_extents = 0.5 * object.faces.completed(now).sizes();
}

bool Tracker::is_lost(const TrackedObject& object, UTime at) const {
  const Duration unseen = at - object.last_seen;
  if (!object.confirmed) return object.misses >= kMissesOfTentative || unseen > kTentativeUnseen;
  if (object.misses >= kMissesToDelete || unseen > config_.remember_rest) return true;
  if (is_stationary(object)) return false;
  // At the largest gate, what it would find may as well be another obstacle.
  const bool is_vague = unseen.seconds() > kUnseenAfter && face_gate(place_sigma(object)) >= kMaxFaceGate;
  return is_vague || unseen > kSightingCoast;
}

Vec3 Tracker::note_frame(State& state, const SightingSet& frame) const {
  Vec3 sensor_velocity = Vec3::Zero();
  const auto last = std::ranges::find(state.views, frame.sensor_id, &SensorRecord::sensor_id);
  if (last != state.views.end()) {
    const Duration since = frame.at - last->at;
    if (since > Duration{} && since < kVelocitySpan)
      sensor_velocity = (frame.view.sensor_position - last->from) / since.seconds();
  }
  note_view(state, {frame.sensor_id, frame.at, frame.view.range_m, frame.view.sensor_position, 0});
  return sensor_velocity;
}

std::vector<PredictedFaces> Tracker::predicted_faces(const std::vector<TrackedObject>& objects) const {
  std::vector<PredictedFaces> predicted;
  predicted.reserve(objects.size());
  for (const TrackedObject& object : objects) {
    const double sigma = is_stationary(object) ? 0.0 : place_sigma(object);
    predicted.push_back({&object.faces, anchor(object), face_gate(sigma)});
  }
  return predicted;
}

void Tracker::look_for(TrackedObject& object, const SightingSet& frame, const std::vector<Box>& found) const {
  if (object.last_seen_by != frame.sensor_id && frame.at - object.last_seen <= kOthersMissAfter) return;
  const Box box = object.faces.completed(anchor(object));
  if (!is_looked_through(frame.view, box) && !contains(found, box)) return;
  ++object.age;
  object.hits <<= 1;
  object.misses += frame.view.kind == ViewKind::Spherical ? kMissOfLidar : 1;
}

void Tracker::limit_hidden_ends(TrackedObject& object, const SensorView& view) const {
  const Vec3 at = anchor(object);
  const Vec3 from_sensor = at - view.sensor_position;
  const double beyond = from_sensor.norm() - view.range_m;
  if (beyond > kFarthestEnd) return;
  const double place = is_stationary(object) ? 0.0 : object.moving.lead().variance().minCoeff();
  object.faces.limit_hidden_ends(view, at, std::sqrt(frame_variance(kFrameOffset, from_sensor, Vec3::Zero()) + place));
}

void Tracker::remove_lost(State& state, UTime at) const {
  std::erase_if(state.sighted, [&](const TrackedObject& object) {
    const bool is_dead = is_lost(object, at);
    if (is_dead && object.misses > 0 && object.detections == 1 && !object.confirmed) ++state.existence.never;
    return is_dead;
  });
}

void Tracker::advance(State& state, const SightingSet& frame, const Vec3& vehicle) const {
  const ObservationSet from = without_detections(frame);
  const Vec3 sensor_velocity = note_frame(state, frame);
  const auto variance_at = [&](const Vec3& p, const Vec3& velocity) {
    return frame_variance(kFrameJitter, p - frame.view.sensor_position, velocity - sensor_velocity);
  };
  predict_to(state, frame.at);
  const std::vector<int> sighting_of = match_sightings(predicted_faces(state.sighted), frame.sightings);
  std::vector<bool> is_taken(frame.sightings.size(), false);
  const auto box_of = [&](const TrackedObject& object) {
    return grown(object.faces.completed(anchor(object)), Vec3::Constant(kPieceMargin));
  };
  std::vector<Box> found;  // boxes of the tracks that were found
  for (std::size_t o = 0; o < state.sighted.size(); ++o) {
    if (sighting_of[o] == kNoSighting) continue;
    TrackedObject& object = state.sighted[o];
    const Sighting& sighting = frame.sightings[static_cast<std::size_t>(sighting_of[o])];
    const bool is_coasting = !is_stationary(object) && object.detections > 1 && !object.faces.is_located_by(sighting);
    // Nothing tells that a coasting mover is what is seen here: soon this gets a track of its own.
    is_taken[static_cast<std::size_t>(sighting_of[o])] = !is_coasting || is_seen_lately(object, frame.at);
    if (is_coasting) continue;
    if (object.detections == 1 && !object.confirmed) ++state.existence.again;
    ++object.age;
    object.hits <<= 1;
    object.misses = std::max(0, object.misses - 1);
    update_faces(object, sighting, variance_at(middle(sighting), object.moving.lead().velocity()), from, state);
    object.confirmed = object.confirmed || std::popcount(object.hits) >= config_.confirm_hits;
    if (const auto sizes = object.faces.measured_sizes(); sizes && object.confirmed) state.sizes.add(object.id, *sizes);
    found.push_back(box_of(object));
  }
  for (std::size_t o = 0; o < state.sighted.size(); ++o) {
    if (sighting_of[o] == kNoSighting) look_for(state.sighted[o], frame, found);
  }
  remove_lost(state, frame.at);
  for (const TrackedObject& object : state.sighted) {
    const bool is_hidden = object.confirmed && object.last_seen != frame.at && is_seen_lately(object, frame.at);
    if (is_hidden) found.push_back(box_of(object));
  }
  for (std::size_t s = 0; s < frame.sightings.size(); ++s) {
    const Sighting& sighting = frame.sightings[s];
    if (is_taken[s] || is_covered(found, visible_part(sighting))) continue;
    const double common = variance_at(middle(sighting), Vec3::Zero());
    state.sighted.push_back(start_faces(sighting, common, from, state.next_id++));
    state.sighted.back().is_doubtful = meets(found, visible_part(sighting));
  }
  for (TrackedObject& object : state.sighted) limit_hidden_ends(object, frame.view);
  constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
  state.views.back().left_out =
      frame.left_out + bound_tracks(state.sighted, kFirstOwnTrackId, kLast, kMaxSightedTracks, vehicle, frame.at);
}

}  // namespace tern
