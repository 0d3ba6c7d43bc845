// Scores the tracker's own predictions against later detections. The scores weigh the motion models and set the
// margins. The steps and their equations: docs/prediction.md.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "core/base/time.h"
#include "core/base/types.h"
#include "predictor/models/model_scores.h"
#include "predictor/tracking/calibration.h"

namespace tern {

/// A track at the time of its last detection.
struct DetectedTrack {
  std::int64_t id = 0;
  UTime born;                    ///< start of its filters; the same id with another time is another motion
  int detections = 1;            ///< since then
  Vec3 position = Vec3::Zero();  ///< as detected, W, m
  Vec3 variance = Vec3::Zero();  ///< of the position, m²
  const BankFilter* bank = nullptr;
  bool is_stationary = false;  ///< true: the scorer stores no prediction of it
};

/// The times after a prediction's start at which it is evaluated, s: two near its start, then two or three per band.
inline constexpr std::array<double, 12> kEvaluatedAhead{0.05, 0.125, 0.25, 0.375, 0.5, 0.75,
                                                        1.0,  1.5,   2.0,  2.5,   3.0, 4.5};
/// The smoothed position at a time is a parabola through the detections within kSmoothingSpan of it, s. Without
/// detections on both sides it is the straight line between two neighbours that are at most kMaxGap apart, s.
inline constexpr double kSmoothingSpan = 0.2, kMaxGap = 0.5;

/// A track's speed is its distance over this span, s; one of kEvaluatedAhead. Over this span, noise and a single
/// exchanged detection change the speed little.
inline constexpr double kSpeedSpan = 0.5;

/// A scene is slow once this many tracks were seen to move, all slower than kSlowSpeed. By the rule of succession the
/// next one is faster once in 18 times. After the first faster track, the scene is not slow for the rest of the flight.
inline constexpr std::size_t kMinMovers = 16;
/// A slower track does not count as moving, m/s.
inline constexpr double kMinMovingSpeed = 0.5;

/// The most exchanged tracks that one update() looks for. A flood of false detections holds more; there a track that
/// was perhaps exchanged counts as a miss, which makes intervals wider.
inline constexpr int kMaxExchangeTests = 20'000;

/// The scores of one prediction.
struct ScoredPrediction {
  TrackClass kind = TrackClass::New;
  std::size_t bands = 0;    ///< number of bands, from the first, that were evaluated to their end
  PerBand<float> scores{};  ///< the largest covering_margin() of each band
};

/// For every track, stores predictions at times of detections, compares them with the positions smoothed from later
/// detections, and feeds four estimators:
/// - ModelScores: the weight of each motion model, for the track and for all tracks of its pool;
/// - LearntModel: samples of the regression;
/// - Calibration: the score of each band, and whether the published interval missed;
/// - the highest speeds seen, which choose the prior (SceneSpeed) and bound the reach.
///
/// | event of a moving track                                  | effect                                                |
/// |----------------------------------------------------------|-------------------------------------------------------|
/// | detection 1, 2, 3, 5 and 8; kYoungAge; each kScorePeriod | a prediction is stored with its margins               |
/// | kSmoothingSpan after one of kEvaluatedAhead              | its error there is evaluated; a sample of LearntModel |
/// | the same, at the end of a band                           | the score of the band goes to Calibration             |
/// | the same, at one of kScoredAhead                         | the errors of all models go to ModelScores            |
/// | no smoothed position, or the last time evaluated         | the prediction is finished                            |
/// | the track is deleted                                     | its stored predictions are finished as they are       |
///
/// A value: the same tracks in the same order give the same weights and margins.
class PredictionScorer {
 public:
  /// @param learns  whether the learnt model takes part (learnt_model.h)
  explicit PredictionScorer(double confidence, bool learns = true);

  /// Takes one observation set. @pre sets come in order of time
  /// @param seen  the tracks that were detected at `at`, ascending by id
  /// @param tracks  the ids of all existing tracks; all others are forgotten
  void update(UTime at, const std::vector<DetectedTrack>& seen, const std::set<std::int64_t>& tracks);

  /// How a track is to be predicted.
  struct Assessment {
    HorizonWeights weights;
    TrackClass kind = TrackClass::New;
    std::optional<std::size_t> group;  ///< of the learnt model; present wherever that model has a weight
  };
  /// Returns the weights of the models for a track, and its class. A track without scores has the weights of its pool.
  /// @param track  in its present state, which may be newer than the last update()
  [[nodiscard]] Assessment assessment(const DetectedTrack& track, UTime last_seen) const;
  [[nodiscard]] const Calibration& calibration() const { return calibration_; }
  [[nodiscard]] const LearntModel& learnt() const { return learnt_; }
  /// The largest mean speed per axis over kSpeedSpan that any track had, m/s.
  [[nodiscard]] double max_axis_speed() const { return max_axis_speed_; }
  /// The predictions that the last update() finished.
  [[nodiscard]] const std::vector<ScoredPrediction>& finished() const { return finished_; }

 private:
  struct Measurement {
    UTime at;
    Vec3 z, r;  // W, m; m²
  };
  struct ModelPrediction {
    Vec3 centre, variance;
  };
  struct StoredPrediction {
    // The prediction: its start, and the mixture at each of kEvaluatedAhead.
    UTime at;
    Vec3 position;  // as detected at `at`
    std::array<MixturePrediction, kEvaluatedAhead.size()> mixture;

    // The interval of each confidence level, for Calibration. A half-width is the running maximum over time.
    PerLevel margins;
    SceneSpeed scene_speed = SceneSpeed::Any;  // of the prior in use
    std::array<Vec3, kConfidenceLevels.size()> half_width;
    std::array<bool, kConfidenceLevels.size()> missed{};

    // The progress of the evaluation.
    std::size_t next = 0;  // index of kEvaluatedAhead
    double score = 0.0;    // the largest of the current band so far
    ScoredPrediction result;

    // Each model's own prediction, for ModelScores.
    std::array<PerCandidate<ModelPrediction>, kScoredHorizons> by_model;
    std::size_t pool = 0;

    // The regressors of a sample, for LearntModel.
    LearntInput learnt_input;
    std::optional<std::size_t> group;
    double learnt_horizon_s = 0.0;  // the learnt model took part up to here
  };
  struct History {
    UTime born, last_predicted;
    double recent_speed = 0.0;  // m/s, decays
    ModelScores own;
    std::vector<Measurement> measurements;
    std::deque<StoredPrediction> predictions;
    std::vector<UTime> due;  // the next evaluation of each prediction, kept apart because predictions are large
  };
  void add_measurement(const DetectedTrack& track, UTime at, History& history);
  void store_prediction(const DetectedTrack& track, UTime at, History& history) const;
  void evaluate_due(std::int64_t id, History& history);
  void evaluate(StoredPrediction& prediction, const Measurement& truth, std::int64_t id, History& history);
  void score_models(const StoredPrediction& prediction, const Measurement& truth, std::size_t horizon,
                    History& history);
  void add_sample(const StoredPrediction& prediction, const Measurement& truth);
  void refit_learnt_model();
  void add_speed(const Vec3& velocity, std::int64_t id);
  [[nodiscard]] SceneSpeed scene_speed() const;
  /// Returns the margin with which two predictions together cover two tracks whose detections were exchanged: each
  /// track is where the other one was predicted. For a track that did not exist at prediction.at, only the first
  /// prediction must cover it. In both cases each box still contains an obstacle, so a plan that avoids both boxes is
  /// safe. Infinite if no other track fits. O(tracks).
  double exchanged_margin(const StoredPrediction& prediction, const Measurement& truth, const History& own);
  /// A box that contains all measurements of a track.
  struct Place {
    Box box;
    const History* history;
  };
  void note_places(const std::vector<DetectedTrack>& seen);
  [[nodiscard]] const History* find_history(std::int64_t id, UTime born) const;
  [[nodiscard]] double learnt_horizon_s(std::optional<std::size_t> group) const {
    return learns_ && group ? learnt_.horizon_s(*group) : 0.0;
  }
  [[nodiscard]] static std::size_t pool_of(const DetectedTrack& track, UTime at, double recent_speed);
  [[nodiscard]] static TrackClass class_of(const DetectedTrack& track, UTime at, const HorizonWeights& weights);

  bool learns_;
  Calibration calibration_;
  std::array<ModelScores, 3> pools_;  // slow tracks, fast tracks, all tracks
  LearntModel learnt_;
  std::map<std::int64_t, History> histories_;
  std::vector<Place> places_;  // of histories_, during update()
  int exchange_tests_left_ = 0;
  std::vector<ScoredPrediction> finished_;
  double max_axis_speed_ = 0.0;
  double max_speed_ = 0.0;         // norm, m/s
  std::set<std::int64_t> movers_;  // at most kMinMovers
  std::array<BankOutputRows, kEvaluatedAhead.size()> output_rows_;
  std::array<std::array<LearntCoefficients, kEvaluatedAhead.size()>, kLearntGroups> learnt_coefficients_;
};

}  // namespace tern
