// Judges predictions by what came: which models predict best, and how far the promise has to reach.
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

/// What the judge sees of a track: its filters and its last detection, at the time of that detection.
struct SeenTrack {
  std::int64_t id = 0;
  UTime born;                    ///< when its filters began; another time is another motion
  int detections = 1;            ///< since then
  Vec3 position = Vec3::Zero();  ///< as detected, W, m
  Vec3 variance = Vec3::Zero();  ///< m²
  const BankFilter* bank = nullptr;
  bool rests = false;  ///< then nothing is predicted of it here
};

/// A promise is judged at these times after its making, s: near its beginning, and twice or thrice per band.
inline constexpr std::array<double, 12> kJudgedAhead{0.05, 0.125, 0.25, 0.375, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0, 4.5};
/// The truth at a time is a parabola through the detections so near to it, s; where none lie on both sides of it, the
/// straight line between two neighbours at most kWidestGap apart.
inline constexpr double kSmoothed = 0.2, kWidestGap = 0.5;

/// Of kJudgedAhead, s: the speed that a track had is its way in this time, which noise and one exchanged detection
/// falsify little.
inline constexpr double kSpeedSpan = 0.5;

/// A world is taken for slow when so many tracks were seen to move, none of them as fast as kSlowSpeed: by the rule of
/// succession the next is faster once in 18 times. One that is makes it a world of any pace, for good. What is slower
/// than kStill says nothing.
inline constexpr std::size_t kMoversOfAWorld = 16;
inline constexpr double kStill = 0.5;  ///< m/s

/// What became of one promise.
struct Judged {
  TrackClass kind = TrackClass::New;
  std::size_t bands = 0;    ///< so many were seen to their end
  PerBand<float> scores{};  ///< containing_margin(), the largest of the band
};

/// Feeds on observation sets in order of time, once nothing older can come, and predicts for itself at the times of
/// detections as tracks are predicted for others. A value: the same tracks in the same order give the same weights and
/// margins.
class Judge {
 public:
  /// @param learns  with the model that is learnt (learnt_model.h)
  explicit Judge(double confidence, bool learns = true);

  /// @param seen  the tracks that were detected at `at`
  /// @param tracks  the ids of all that there are: the others are forgotten
  void take(UTime at, const std::vector<SeenTrack>& seen, const std::set<std::int64_t>& tracks);

  /// The models' weights for a track (of one that is not known, those of all tracks like it), and its class.
  struct Verdict {
    HorizonWeights weights;
    TrackClass kind = TrackClass::New;
    std::optional<std::size_t> group;  ///< of the learnt model; where that has a weight there is one
  };
  /// @param track  as it is now: its speed and age count, whatever take() has come to hear of it
  [[nodiscard]] Verdict verdict(const SeenTrack& track, UTime last_seen) const;
  [[nodiscard]] const Calibration& calibration() const { return calibration_; }
  [[nodiscard]] const LearntModel& learnt() const { return learnt_; }
  /// The largest mean speed per axis over kSpeedSpan that any track had, m/s.
  [[nodiscard]] double fastest() const { return fastest_; }
  /// The promises that the last take() came to an end with.
  [[nodiscard]] const std::vector<Judged>& judged() const { return judged_; }

 private:
  struct Sample {
    UTime at;
    Vec3 z, r;
  };
  struct Said {
    Vec3 centre, variance;
  };
  struct Issue {
    UTime at;
    Vec3 from;  // where it was detected
    WorldPace pace = WorldPace::Any;
    Judged judged;
    std::size_t pool = 0;
    std::size_t next = 0;  // of kJudgedAhead
    double score = 0.0;    // of the band so far
    // By level of confidence: what was promised, its half-width so far, and whether it was too little.
    PerLevel margins;
    std::array<Vec3, kConfidenceLevels.size()> half;
    std::array<bool, kConfidenceLevels.size()> broken{};
    std::array<Mixed, kJudgedAhead.size()> said;
    std::array<PerCandidate<Said>, kScoredHorizons> models_said;
    LearntFrom learnt_from;
    std::optional<std::size_t> group;  // of learnt_from
    double learnt_to = 0.0;            // how far ahead the learnt model said anything
  };
  struct History {
    UTime born, issued;
    double fastest = 0.0;  // m/s, forgotten slowly
    ModelScores own;
    std::vector<Sample> samples;
    std::deque<Issue> issues;
    std::vector<UTime> due;  // of each: when there is something to judge again. Most have not, and are large
  };
  void follow(const SeenTrack& track, UTime at, History& history);
  void issue(const SeenTrack& track, UTime at, History& history) const;
  void score(std::int64_t id, History& history);
  void score(Issue& issue, const Sample& truth, std::int64_t id, History& history);
  void learn(const Issue& issue, const Sample& truth);
  void look_anew();
  void see_speed(const Vec3& velocity, std::int64_t id);
  [[nodiscard]] WorldPace pace() const;
  /// The least q by which two promises hold what came, had their tracks exchanged detections since:
  /// each thing is where the other track's was promised. Of a track that was not there yet, that the promise holds it.
  /// So things that pass each other closely do not make promises wide that are kept: who keeps clear of both boxes
  /// keeps clear of both things, whatever they are called. Infinite where there is none. O(tracks).
  [[nodiscard]] double exchanged_margin(const Issue& issue, const Sample& truth, const History& own) const;
  [[nodiscard]] const History* known(std::int64_t id, UTime born) const;
  [[nodiscard]] double learnt_to(std::optional<std::size_t> group) const {
    return learns_ && group ? learnt_.known_to(*group) : 0.0;
  }
  [[nodiscard]] static std::size_t pool_of(const SeenTrack& track, UTime at, double fastest);
  [[nodiscard]] static TrackClass class_of(const SeenTrack& track, UTime at, const HorizonWeights& weights);

  bool learns_;
  Calibration calibration_;
  std::array<ModelScores, 3> pools_;
  LearntModel learnt_;
  std::map<std::int64_t, History> histories_;
  std::vector<Judged> judged_;
  double fastest_ = 0.0;
  double top_speed_ = 0.0;         // over all axes, m/s
  std::set<std::int64_t> movers_;  // kMoversOfAWorld at most
  std::array<BankLook, kJudgedAhead.size()> looks_;
  std::array<std::array<LearntLook, kJudgedAhead.size()>, kLearntGroups> learnt_looks_;
};

}  // namespace tern
