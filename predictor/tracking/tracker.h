// Tracks from noisy, late, anonymous detections: born, confirmed, coasting, dead.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include "core/world/observation.h"
#include "core/world/track.h"
#include "core/world/track_bounds.h"
#include "predictor/models/prediction_interval.h"
#include "predictor/tracking/prediction_scorer.h"
#include "predictor/tracking/rest_record.h"
#include "predictor/tracking/tracked_object.h"

namespace tern {

/// Tracks of detections without an id get ids from here on; sensors and owners use smaller ones.
inline constexpr std::int64_t kFirstOwnTrackId = 1'000'000'000;
/// A detection with its track's id farther than this is another thing, or a jump: the track starts anew there.
inline constexpr double kJumpGate = 100.0;
/// Sizes tell who is who, but alone they exclude nobody, whatever part of a thing is seen: standard deviation of a
/// half-extent as a share of the largest, beside that of a face; and the most that they count for, of a surprise.
inline constexpr double kSizeShare = 0.25, kMaxSizeCost = 20.0;
/// How far back observations may come out of order.
inline constexpr Duration kReorderWindow{300'000};
/// Extents grow at once to the largest seen and shrink by this share of the difference per detection.
inline constexpr double kExtentShrink = 0.1;
/// The resting hypothesis: so little acceleration is put down to what rests, m/s^1.5 (√ of the spectral density).
inline constexpr double kRestingSigma = 0.01;
/// It is given up when the average of its χ²₃ over about ten detections exceeds this (mean 3, deviation 0.56: 4
/// deviations).
inline constexpr double kRestingLimit = 5.3;
inline constexpr double kRestingForgetting = 0.1;
/// A tentative track is buried after so long without a detection even if the sensor that saw it sends no more sets: 15
/// frames of a sensor at 10 Hz.
inline constexpr Duration kTentativeUnseen{1'500'000};
/// A thing whose box is farther from the sensor than its range less this should not be seen, m: some σ and the
/// vehicle's way within the sensor's frame.
inline constexpr double kRangeMargin = 0.5;
/// What is not seen beyond its sensor's range is predicted while it is known where it is, to so many metres.
inline constexpr double kMaxUnseenAlpha = 1.0;
/// What is unseen for longer, s, has one α for all confidences: they are calibrated by what is seen again and again.
inline constexpr double kUnseenAfter = 0.3;
/// Who has been unseen for that long, and was missed by so many of its sensor's sets, is not surely what is found there
/// next: that may have come into view just now. Its motion begins anew.
inline constexpr int kMissesToRestart = 3;
/// Of 1 − confidence, the share that is left to a start that the α of what rests does not contain.
inline constexpr double kStartShare = 0.5;
/// The crossings of Rice's formula for what rests: π/2 of a speed that does not change, and room for noise.
inline constexpr double kRestCrossings = 2.5;
/// Detected once, a track is published until its sensor has failed to see it so often.
inline constexpr int kMissesToHide = 2;
/// What rests has no speed beyond so many standard deviations per axis, or beyond kRestingSpeed m/s.
inline constexpr double kRestingSpeedSigmas = 3.0;
inline constexpr double kRestingSpeed = 0.05;
/// Bounds are told at the end of the piece of a prediction that holds this time.
inline constexpr Duration kBoundsAhead{1'000'000};

struct TrackerConfig {
  PredictionSpec prediction;
  int confirm_hits = 3;             ///< a track is confirmed once detected in so many …
  int confirm_window = 5;           ///< … of its first observation sets that count (Tracker), hits ≤ window ≤ 32
  Duration coast{1'500'000};        ///< a confirmed track dies when not detected for longer
  Duration resting_after{600'000};  ///< a track that has been consistent with rest so long is predicted at rest
  /// What rests and is out of the sensor's range, and what only a sensor saw that has fallen silent, outlives its last
  /// detection so long: the world goes on behind us.
  Duration remember_rest{30'000'000};
  /// With the model that is learnt (learnt_model.h).
  bool learns = true;
};

/// How often what was detected once was detected again: what of it was real.
struct ExistenceRecord {
  int again = 0, never = 0;  ///< tracks
  /// Laplace's rule of succession, begun with one that was.
  [[nodiscard]] double real_share() const { return (again + 1.0) / (again + never + 1.0); }
};

/// What became of an observation set.
enum class UpdateOutcome {
  Used,
  TooOld,    ///< older than the newest by more than kReorderWindow
  Repeated,  ///< there was a set of that sensor and time
};

/// Steps of one update, in this order. Predict every track to the observation's time. Match detections that have ids by
/// id, unless ids were exchanged; the others within the gate by the most likely assignment, first to confirmed tracks,
/// what remains to tentative ones. Update what is matched; count hits and misses, confirm (n of m), bury. Start a
/// tentative track from each detection that is left. Ids, sensors': one space for all sensors.
///
/// Only the sensor that saw a track last can miss it: sensors see different things at different rates, and that one of
/// them does not see what another does says nothing. So a set counts in a track's age and hits if it holds a detection
/// of it or is of that sensor, and a confirmed track dies by sets of that sensor; should the sensor be silent, the
/// others' sets bury the track after kTentativeUnseen or, confirmed, after remember_rest.
///
/// A pure function of the observations: sets that come out of order within kReorderWindow give the same tracks as in
/// order of (time, sensor). Not thread-safe. A set of d detections and t tracks costs O(d·t) and the assignment's
/// groups.
class Tracker {
 public:
  explicit Tracker(const TrackerConfig& config);

  /// Nothing changes unless the answer is Yes. The tracker has no clock: a set from the future makes all others too
  /// old.
  UpdateOutcome update(const ObservationSet& observations);

  /// The tracks predicted from `now` over the horizon, kind Estimated, by id ascending: what is new from its first
  /// detection on, if it is real more often than promises are broken. Tracks whose detections have stopped altogether
  /// remain, with growing α; but what has left its sensor's range is left out once its α at the start exceeds
  /// kKnownWithin: then it says no more than that anything may come from there, and that nobody promises. If `now` lies
  /// before the newest observation, that is where they start.
  /// @param why  what each of them is as wide as it is by, in the same order, if anybody asks
  [[nodiscard]] std::vector<Track> predict(UTime now, std::vector<TrackBound>* why = nullptr) const;

  /// All tracks, tentative ones too, by id ascending, at newest().
  [[nodiscard]] const std::vector<TrackedObject>& objects() const { return newest_state().objects; }
  /// What was seen of things at rest, at newest().
  [[nodiscard]] const RestRecord& rest() const { return newest_state().rest; }
  /// Time of the newest observation; 0 when there was none.
  [[nodiscard]] UTime newest() const { return steps_.empty() ? UTime{} : steps_.back().observations.at; }
  /// True if it is predicted at rest.
  [[nodiscard]] bool is_stationary(const TrackedObject& object) const;
  /// What was learnt of predictions: models' weights and margins. It lags by kReorderWindow.
  [[nodiscard]] const PredictionScorer& scorer() const { return scorer_; }
  /// The weights and the class that an object of objects() is predicted with.
  [[nodiscard]] PredictionScorer::Assessment assessment(const TrackedObject& object) const;

 private:
  /// What a sensor saw last.
  struct SensorView {
    std::int32_t sensor_id = 0;
    UTime at;
    double range_m = 0.0;  // 0: without limit
    Vec3 from = Vec3::Zero();
  };
  struct State {
    UTime at;
    std::vector<SensorView> views;  // one per sensor
    std::int64_t next_id = kFirstOwnTrackId;
    std::vector<TrackedObject> objects;
    RestRecord rest;
    ExistenceRecord existence;
  };
  struct Step {
    ObservationSet observations;
    State after;
  };
  [[nodiscard]] const State& newest_state() const { return steps_.empty() ? before_steps_ : steps_.back().after; }
  void advance(State& state, const ObservationSet& observations) const;
  void predict_to(State& state, UTime at) const;
  void take(TrackedObject& object, const Detection& detection, const ObservationSet& from) const;
  void take(TrackedObject& object, const Detection& detection, const ObservationSet& from, RestRecord& rest) const;
  [[nodiscard]] TrackedObject start_track(const Detection& detection, const ObservationSet& from,
                                          std::int64_t id) const;
  [[nodiscard]] bool is_expired(const TrackedObject& object, const ObservationSet& observations) const;
  [[nodiscard]] double match_cost(const TrackedObject& object, UTime at, const Detection& detection) const;
  /// A box that holds all detections of at most this variance whose surprise is finite.
  [[nodiscard]] Box gate_box(const TrackedObject& object, UTime at, const Vec3& variance) const;
  /// Whether it rested when it was last seen, longer ago than `coast`. Then what is found there belongs to it, not
  /// whatever a mover could have become.
  [[nodiscard]] bool is_remembered(const TrackedObject& object, UTime at) const;
  [[nodiscard]] bool is_published(const TrackedObject& object, const ExistenceRecord& existence) const;
  /// Whether what is detected as this track may as well be something new.
  [[nodiscard]] bool may_be_another(const TrackedObject& object, UTime at) const;
  /// Whether it has left its sensor's range and says no more than that anything may come from there.
  [[nodiscard]] static bool has_left_range(const TrackedObject& object, const std::vector<SensorView>& views,
                                           const Waypoint& start);
  void settle(const Step& step);
  [[nodiscard]] DetectedTrack seen(const TrackedObject& object) const;
  [[nodiscard]] double top_speed() const;  // of what is new or starts
  /// Where a start is contained, so is one that the last detection shows and the filter does not yet believe.
  /// @return with what the filter alone says at level 0
  [[nodiscard]] std::pair<Waypoint, Vec3> resting_at(const TrackedObject& object, const State& state, UTime from,
                                                     double ahead_s) const;
  /// Waypoints at ends_, and what of a bound they know: all but what is promised.
  struct Forecast {
    std::vector<Waypoint> waypoints;
    TrackBound bound;
  };
  [[nodiscard]] Forecast at_rest(const TrackedObject& object, const State& state, UTime from) const;
  /// What the tracks of one prediction share.
  struct PredictionInputs {
    UTime from;
    PerLevel of_unsure;                 // margins of what was detected once, and may be a false alarm
    std::vector<BankOutputRows> looks;  // at ends_
    std::map<std::pair<std::size_t, UTime>, std::vector<LearntCoefficients>> learnt;  // by group and last detection
  };
  [[nodiscard]] const std::vector<LearntCoefficients>& learnt_coefficients(std::size_t group, UTime last_seen,
                                                                           PredictionInputs& ahead) const;
  [[nodiscard]] Forecast moving(const TrackedObject& object, PredictionInputs& ahead) const;

  TrackerConfig config_;
  std::vector<Duration> ends_;         // of pieces
  std::size_t bound_at_ = 0;           // of them, where bounds are told
  double model_sigmas_ = 0.0;          // of the models' own bound at level 0
  std::vector<BankStep> steps_ahead_;  // to them
  std::array<double, kConfidenceLevels.size()> rest_quantiles_{};
  State before_steps_;
  State spare_;             // memory for the next step: its meaning is over
  std::deque<Step> steps_;  // ascending by (time, sensor), the newest kReorderWindow
  PredictionScorer scorer_;
};

}  // namespace tern
