// Tracks obstacles from noisy, late, anonymous detections, and predicts them. The steps: docs/prediction.md.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "core/world/observation.h"
#include "core/world/sighting.h"
#include "core/world/track.h"
#include "core/world/track_bounds.h"
#include "predictor/faces/sighting_matching.h"
#include "predictor/models/prediction_interval.h"
#include "predictor/tracking/prediction_scorer.h"
#include "predictor/tracking/rest_record.h"
#include "predictor/tracking/tracked_object.h"

namespace tern {

/// The first id of tracks whose detections have no id. Sensors and owners use smaller ids.
inline constexpr std::int64_t kFirstOwnTrackId = 1'000'000'000;
/// A detection with its track's id but a larger distance2 is another obstacle, or a jump: the filters restart.
inline constexpr double kJumpGate = 100.0;
/// Sizes add to the cost of a match, but never exclude one, because a sensor may see any part of an obstacle.
/// kSizeShare is the standard deviation of a half-extent as a share of the largest one. kMaxSizeCost bounds the added
/// cost.
inline constexpr double kSizeShare = 0.25, kMaxSizeCost = 20.0;
/// Observation sets are put in order if they are at most this much older than the newest.
inline constexpr Duration kReorderWindow{300'000};
/// A set out of order is used if all later sets together update at most so many tracks again, which takes some 150 ms.
inline constexpr std::size_t kMaxReplayed = 10'000;
/// Half-extents grow at once to the largest seen, and shrink by this share of the difference per detection.
inline constexpr double kExtentShrink = 0.1;
/// The resting hypothesis is a constant velocity with this √ of the spectral density of acceleration, m/s^1.5.
inline constexpr double kRestingSigma = 0.01;
/// The hypothesis fails when the average of its χ²₃ over about ten detections exceeds this: the mean 3 plus four
/// standard deviations of 0.56.
inline constexpr double kRestingLimit = 5.3;
inline constexpr double kRestingForgetting = 0.1;
/// The same for one axis, with the same probability of a false alarm, some 3e-4 for an update. The average is about
/// that of 19 independent χ²₁, and kRestingLimit is about that of 57.
inline constexpr double kAxisRestLimit = 2.5;
/// A tentative track whose sensor is silent is deleted this long after its last detection: 15 frames at 10 Hz.
inline constexpr Duration kTentativeUnseen{1'500'000};
/// A track that has left its sensor's range is published while its α at the start is at most this, m.
inline constexpr double kMaxUnseenAlpha = 1.0;
/// A track without detections for longer than this, s, has one α for all levels. The lower levels are calibrated on
/// tracks that are seen again and again.
inline constexpr double kUnseenAfter = 0.3;
/// After kUnseenAfter and this many missed sets of its sensor, the filters restart from the next matched detection. It
/// may be another obstacle that just came into view.
inline constexpr int kMissesToRestart = 3;
/// The share of 1 − confidence that is left to starts of stationary tracks which α does not cover.
inline constexpr double kStartShare = 0.5;
/// The crossings (escape_probability()) of a stationary track: π/2 for a speed that does not change, and a reserve for
/// noise.
inline constexpr double kRestCrossings = 2.5;
/// A track that was detected once is published until its sensor has missed it this often.
inline constexpr int kMissesToHide = 2;
/// A stationary track has on each axis a speed of at most kRestingSpeed, m/s, or of this many standard deviations.
inline constexpr double kRestingSpeedSigmas = 3.0;
inline constexpr double kRestingSpeed = 0.05;
/// True if a resting hypothesis agrees with speed 0.
inline bool is_slow(const AxisFilter& axis) {
  return std::abs(axis.v) <= std::max(kRestingSpeed, kRestingSpeedSigmas * std::sqrt(axis.vv));
}
/// TRACK_BOUNDS reports the bounds at the end of the piece that contains this time ahead.
inline constexpr Duration kBoundsAhead{1'000'000};

/// Tracks by sightings: a confirmed one is deleted after this many misses in sum, a tentative one after
/// kMissesOfTentative. A frame of a lidar, which is three times as slow, counts kMissOfLidar.
inline constexpr int kMissesToDelete = 4, kMissesOfTentative = 2, kMissOfLidar = 2;
/// A track by sightings that was not seen for longer can be missed by every sensor that sees through it. These are
/// five frames at 10 Hz.
inline constexpr Duration kOthersMissAfter{500'000};
/// A track by sightings that moves and was not seen for longer is deleted, wherever it may be. It ends sooner, after
/// kUnseenAfter, once its place is so uncertain that its gate is kMaxFaceGate.
inline constexpr Duration kSightingCoast{3'000'000};
/// The newest sets of so many sensors are kept.
inline constexpr std::size_t kMaxSensors = 64;
/// The most tracks by sightings.
inline constexpr std::size_t kMaxSightedTracks = 400;
/// The variance, m², of a position along an axis on which a sighting has none.
inline constexpr double kNoPosition = 900.0;
/// A face is an outlier if it lies farther from its prediction than this, m, and three standard deviations. It is
/// another face, or two obstacles look like one. After more than kMostRejected in a row it replaces the known face.
inline constexpr double kFaceOutlier = 0.15, kFaceOutlierSigmas = 3.0;
inline constexpr int kMostRejected = 8;
/// A sighting in the box of a track that was seen in the same frame is a piece of it. The box is grown by this, m.
inline constexpr double kPieceMargin = 0.2;
/// A track by sightings is at rest only if its speed is known: on each axis |v| + 2σ is at most this, m/s. The last
/// sighting decides: out of sight σ grows.
inline constexpr double kKnownRest = 0.12;
/// It has started once it is this far from its place of rest, m, or rests again farther than kFaceGate from it.
inline constexpr double kSightedStart = 1.0;
/// Its α allows for the speed that its moving filter sees, for this long ahead, s. By then a motion shows.
inline constexpr double kDriftTime = 1.0;
/// A track by sightings is at rest only if it has positions along this many axes. Along another axis a track that rests
/// is taken to rest as well.
inline constexpr int kAxesToRest = 2;
/// Measured faces are published farther out by this many standard deviations.
inline constexpr double kReachSigmas = 2.0;

struct TrackerConfig {
  PredictionSpec prediction;
  int confirm_hits = 3;             ///< a track is confirmed after this many detections …
  int confirm_window = 5;           ///< … within its first counted sets (Tracker), this many; hits ≤ window ≤ 32
  Duration coast{1'500'000};        ///< a confirmed track survives its last detection by this time
  Duration resting_after{600'000};  ///< a track that was consistent with rest for this long is stationary.
  /// Survival after the last detection of a stationary track out of range, and of any confirmed track whose sensor is
  /// silent.
  Duration remember_rest{30'000'000};
  /// Whether the learnt model takes part (learnt_model.h).
  bool learns = true;
};

/// How many tracks that were detected once were detected again.
struct ExistenceRecord {
  int again = 0, never = 0;  ///< tracks
  /// The estimated share of real obstacles: Laplace's rule of succession, which begins with one success.
  [[nodiscard]] double real_share() const { return (again + 1.0) / (again + never + 1.0); }
};

enum class UpdateOutcome {
  Used,
  TooOld,     ///< older than the newest set by more than kReorderWindow
  TooCostly,  ///< later sets would have to be used again for more tracks than kMaxReplayed in sum
  Repeated,   ///< a set of that sensor and time was used already
};

/// One update does this, in order:
/// 1. It predicts every track to the time of the observation set.
/// 2. It matches detections to tracks (matching.h), and updates the matched tracks.
/// 3. It counts hits and misses, confirms and deletes tracks.
/// 4. Each detection that is left starts a tentative track. Ids are common to all sensors.
/// 5. If the tracks are more than kMaxAnonymousTracks or kMaxNamedTracks (track_bound.h), the farthest from the vehicle
///    are deleted. left_out() counts those of them that were detected.
///
/// Only the sensor that detected a track last can miss it, because sensors see different things at different rates. A
/// set *counts* for a track if it is from that sensor or detects the track. A track by sightings that is out of sight
/// for kOthersMissAfter can be missed by every sensor.
///
/// | state      | event                                                            | effect          |
/// |------------|------------------------------------------------------------------|-----------------|
/// | tentative  | confirm_hits detections in the first confirm_window counted sets | confirmed       |
/// | tentative  | confirm_window counted sets with fewer detections                | deleted         |
/// | tentative  | another sensor's set, kTentativeUnseen after the last detection  | deleted         |
/// | confirmed  | a miss later than `coast`, unless stationary and out of range    | deleted         |
/// | confirmed  | any set later than `remember_rest` after the last detection      | deleted         |
/// | any        | distance2 above kJumpGate, or a detection after kMissesToRestart | filters restart |
/// | any        | consistent with rest for `resting_after`                         | stationary      |
/// | stationary | the resting hypothesis fails                                     | filters restart |
///
/// Each axis of W of a track that moves has a resting hypothesis of its own (tracker_axes.cpp).
///
/// A pure function of the observations. Sets that come out of order within kReorderWindow give the same tracks as in
/// order of (time, sensor). A set costs its matching (matching.h) and some microseconds per track. Not thread-safe.
class Tracker {
 public:
  explicit Tracker(const TrackerConfig& config);

  /// Takes an observation set; only the outcome Used changes the tracker. @pre the time is not in the future: the
  /// tracker has no clock, and every older set would be TooOld
  /// @param vehicle  W, m
  UpdateOutcome update(const ObservationSet& observations, const Vec3& vehicle);
  /// The same for a vehicle at the sensor.
  UpdateOutcome update(const ObservationSet& observations) {
    return update(observations, observations.sensor_position);
  }
  /// Takes sightings. They have tracks of their own, since a sighting is part of an obstacle and a detection all of it.
  UpdateOutcome update(const SightingSet& sightings, const Vec3& vehicle);

  /// Returns the tracks predicted from `now` over the horizon, of kind Estimated, ascending by id. They start at
  /// newest() if that is later than `now`.
  ///
  /// - A track that was detected once is published if such tracks are real more often than intervals may miss.
  /// - A track without detections stays, with growing α.
  /// - A track that has left its sensor's range is left out once α at its start exceeds kMaxUnseenAlpha. Its interval
  ///   would only say that something may come from there.
  /// @param why  if not null: the reason for each track's width, in the same order
  [[nodiscard]] std::vector<Track> predict(UTime now, std::vector<TrackBound>* why = nullptr) const;

  /// All tracks, tentative ones included, ascending by id, at newest().
  [[nodiscard]] const std::vector<TrackedObject>& objects() const { return newest_state().objects; }
  /// The tracks by sightings, in the same order.
  [[nodiscard]] const std::vector<TrackedObject>& sighted() const { return newest_state().sighted; }
  /// The record of stationary tracks, at newest().
  [[nodiscard]] const RestRecord& rest() const { return newest_state().rest; }
  /// The time of the newest observation set; 0 if there is none.
  [[nodiscard]] UTime newest() const { return steps_.empty() ? UTime{} : steps_.back().observations.at; }
  /// The detections in the newest sets of all sensors whose tracks were deleted because there are too many.
  [[nodiscard]] std::int32_t left_out() const;
  /// True if the track is predicted at rest.
  [[nodiscard]] bool is_stationary(const TrackedObject& object) const;
  /// True if a track that moves is predicted at rest on this axis of W.
  [[nodiscard]] bool is_stationary(const TrackedObject& object, int axis) const;
  /// The records of rest of the axes of W, at newest().
  [[nodiscard]] const AxisRestRecords& rest_of_axes() const { return newest_state().rest_of_axes; }
  /// The weights of the models and the margins. They lag by kReorderWindow.
  [[nodiscard]] const PredictionScorer& scorer() const { return scorer_; }
  /// The weights and the class with which an object of objects() is predicted.
  [[nodiscard]] PredictionScorer::Assessment assessment(const TrackedObject& object) const;

 private:
  /// The newest set of a sensor: its time, and where the sensor was.
  struct SensorRecord {
    std::int32_t sensor_id = 0;
    UTime at;
    double range_m = 0.0;  // 0: unlimited
    Vec3 from = Vec3::Zero();
    std::int32_t left_out = 0;  // detections
  };
  struct State {
    UTime at;
    std::vector<SensorRecord> views;  // one per sensor, the newest last
    std::int64_t next_id = kFirstOwnTrackId;
    std::vector<TrackedObject> objects, sighted;
    RestRecord rest;
    AxisRestRecords rest_of_axes;
    ExistenceRecord existence;
    SizeRecord sizes;
  };
  struct Step {
    ObservationSet observations;  // with sightings: their time and sensor alone
    std::shared_ptr<const SightingSet> sightings;
    Vec3 vehicle;
    State after;
  };
  UpdateOutcome insert(Step step);
  [[nodiscard]] const State& newest_state() const { return steps_.empty() ? before_steps_ : steps_.back().after; }
  void advance(State& state, const ObservationSet& observations, const Vec3& vehicle) const;
  void advance(State& state, const Step& step) const;
  void advance(State& state, const SightingSet& frame, const Vec3& vehicle) const;
  /// Replaces the record of a sensor, and forgets the sensor that is silent longest if there are too many.
  static void note_view(State& state, const SensorRecord& view);
  /// Notes the sensor of a frame. @return its velocity, m/s; 0 if it is not known
  [[nodiscard]] Vec3 note_frame(State& state, const SightingSet& frame) const;
  [[nodiscard]] std::vector<PredictedFaces> predicted_faces(const std::vector<TrackedObject>& objects) const;
  /// Counts a miss of a track that was not found, if it was looked for by a sensor that can miss it.
  /// @param found  boxes of the tracks that were found
  void look_for(TrackedObject& object, const SightingSet& frame, const std::vector<Box>& found) const;
  /// Limits a track's hidden ends by what a view saw to be empty.
  void limit_hidden_ends(TrackedObject& object, const SensorView& view) const;
  /// Updates a track with its sighting. @param common  variance of the frame at its place, m²
  void update_faces(TrackedObject& object, const Sighting& sighting, double common, const ObservationSet& from,
                    State& state) const;
  [[nodiscard]] TrackedObject start_faces(const Sighting& sighting, double common, const ObservationSet& from,
                                          std::int64_t id) const;
  /// The predicted anchor of a track by sightings: by its resting filters if it is stationary.
  [[nodiscard]] Vec3 anchor(const TrackedObject& object) const;
  [[nodiscard]] bool is_lost(const TrackedObject& object, UTime at) const;
  void remove_lost(State& state, UTime at) const;
  void predict_to(State& state, UTime at) const;
  void update_track(TrackedObject& object, const Detection& detection, const ObservationSet& from) const;
  void update_track(TrackedObject& object, const Detection& detection, const ObservationSet& from, State& state) const;
  /// Updates the resting hypotheses of the axes. @param seen  time of the last detection before this one
  void update_rest_of_axes(TrackedObject& object, const Detection& detection, UTime at, UTime seen,
                           AxisRestRecords& records) const;
  [[nodiscard]] TrackedObject start_track(const Detection& detection, const ObservationSet& from,
                                          std::int64_t id) const;
  [[nodiscard]] bool is_expired(const TrackedObject& object, const ObservationSet& observations) const;
  [[nodiscard]] double match_cost(const TrackedObject& object, UTime at, const Detection& detection) const;
  /// Returns a box that contains every detection with at most this variance whose match_cost() is finite.
  [[nodiscard]] Box gate_box(const TrackedObject& object, UTime at, const Vec3& variance) const;
  /// True for a stationary track that was last seen longer ago than `coast`. Only detections at its place belong to it;
  /// the gate of a moving track would be far too wide by then.
  [[nodiscard]] bool is_remembered(const TrackedObject& object, UTime at) const;
  [[nodiscard]] bool is_published(const TrackedObject& object, const ExistenceRecord& existence) const;
  /// True if a detection of this track may be another obstacle (kMissesToRestart).
  [[nodiscard]] bool may_be_another(const TrackedObject& object, UTime at) const;
  /// True if the track has left its sensor's range and its start is no longer known to kMaxUnseenAlpha.
  [[nodiscard]] static bool has_left_range(const TrackedObject& object, const std::vector<SensorRecord>& views,
                                           const Waypoint& start);
  /// True if a track by sightings is out of sight, and its start is known no better than kMaxUnseenAlpha or its size.
  [[nodiscard]] static bool is_handed_over(const TrackedObject& object, const Box& box, UTime from,
                                           const Waypoint& start);
  /// Passes a step that can no longer change on to the scorer.
  void settle(const Step& step);
  [[nodiscard]] DetectedTrack detected_track(const TrackedObject& object) const;
  [[nodiscard]] double top_speed() const;  // of new and starting tracks, m/s per axis.
  /// Returns the waypoint of a stationary track, and the half-width that the filter alone gives at level 0. Once α
  /// allows for a start, it also covers the offset between the last detection and the filter's position.
  [[nodiscard]] std::pair<Waypoint, Vec3> resting_at(const TrackedObject& object, const State& state, UTime from,
                                                     double ahead_s) const;
  /// The waypoints at ends_, and the parts of TrackBound that do not depend on the published α.
  struct Forecast {
    std::vector<Waypoint> waypoints;
    TrackBound bound;
  };
  [[nodiscard]] Forecast at_rest(const TrackedObject& object, const State& state, UTime from) const;
  /// The values that all tracks of one prediction share.
  struct PredictionInputs {
    UTime from;
    PerLevel unsure_margins;           // of tracks that were detected once, and may be false alarms
    std::vector<BankOutputRows> rows;  // at ends_
    std::map<std::pair<std::size_t, UTime>, std::vector<LearntCoefficients>> learnt;  // by group and last detection
  };
  [[nodiscard]] const std::vector<LearntCoefficients>& learnt_coefficients(std::size_t group, UTime last_seen,
                                                                           PredictionInputs& inputs) const;
  /// Makes the half-widths of a track that moves narrow on the axes on which it rests. @param waypoints  at ends_
  void narrow_resting_axes(const TrackedObject& object, const State& state, UTime from,
                           std::vector<Waypoint>& waypoints) const;
  [[nodiscard]] Forecast moving(const TrackedObject& object, PredictionInputs& inputs) const;
  /// Appends the track of an object, unless it is not to be published. @param why  may be null
  void predict(const TrackedObject& object, PredictionInputs& inputs, std::vector<Track>& tracks,
               std::vector<TrackBound>* why) const;

  TrackerConfig config_;
  std::vector<Duration> ends_;         // piece_ends()
  std::size_t bound_at_ = 0;           // index of ends_ at which bounds are reported
  double model_sigmas_ = 0.0;          // of the models' own bound at level 0
  std::vector<BankStep> steps_ahead_;  // to ends_
  std::array<double, kConfidenceLevels.size()> rest_quantiles_{};
  State before_steps_;
  State spare_;             // only its memory is reused
  std::deque<Step> steps_;  // ascending by (time, sensor), the newest kReorderWindow
  PredictionScorer scorer_;
};

}  // namespace tern
