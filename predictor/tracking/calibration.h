// How far what was predicted came out: split-conformal margins per class of track, horizon and level of confidence,
// adapted while flying.
// J. Lei et al., "Distribution-free predictive inference for regression", JASA 2018; I. Gibbs, E. Candès, "Adaptive
// conformal inference under distribution shift", NeurIPS 2021.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/base/types.h"
#include "core/world/track.h"
#include "core/world/track_bounds.h"
#include "predictor/tracking/calibration_prior.h"

namespace tern {

/// What tracks of a class have in common: how long they have been seen, and how they move.
enum class TrackClass {
  New,          ///< seen once
  Young,        ///< seen for less than kYoungAge: its speed is not known yet
  SteadyGrown,  ///< predicted best by steady models (model_bank.h); seen for less than kGrownAge
  SteadyOld,    ///<
  CalmGrown,    ///< by calm ones
  CalmOld,      ///<
  LivelyGrown,  ///< by lively ones
  LivelyOld,    ///<
  Learnt,       ///< by the one that is learnt in the flight (learnt_model.h)
};
inline constexpr std::size_t kTrackClasses = 9;
/// Classes of one pool learn from each other's scores: the old ones that given models predict, of which most flights
/// see most. What is younger moves in ways that its kind hardly foretells, and the learnt model errs in its own; such a
/// class learns from its own scores alone.
inline constexpr std::size_t kPools = 7;
constexpr std::size_t pool_of(TrackClass kind) {
  const auto k = static_cast<std::size_t>(kind);
  if (kind == TrackClass::Learnt) return kPools - 2;
  return k < 2 ? k : k % 2 == 1 ? kPools - 1 : 1 + k / 2;
}
/// What people are told of a class.
constexpr MotionKind motion_kind_of(TrackClass of) {
  const auto k = static_cast<std::size_t>(of);
  return static_cast<MotionKind>(k < 2 ? k : 1 + k / 2);
}
inline constexpr double kYoungAge = 0.3;  ///< s
inline constexpr double kGrownAge = 1.0;  ///< s

/// Margins hold up to so many seconds after a track was seen last; bands of time lie between.
inline constexpr std::array<double, 5> kBandEnds{0.25, 0.5, 1.0, 2.0, 4.5};
inline constexpr std::size_t kBands = kBandEnds.size();
template <typename T>
using PerBand = std::array<T, kBands>;

/// Half-width of a promise, by a number q that data choose: (kModelSigmas + q g(t)) σ(t) for −kModelSigmas ≤ q ≤ 0,
/// kModelSigmas σ(t) + q g(t) beyond, q in metres. What the model knows shrinks with it, whatever the sensor. What it
/// does not know comes on top. Where that falls with t, who publishes or judges takes the largest so far.
inline constexpr double kModelSigmas = 2.0;
/// g(t) = (t + kMarginStart)/(end of the band + kMarginStart): errors grow with time.
inline constexpr double kMarginStart = 0.1;
std::size_t band_of(double ahead_s);  ///< the last one beyond its end
double margin_growth(std::size_t band, double ahead_s);

/// The newest scores, at most so many.
///
/// The score of a prediction is the least q that would have contained, at all times of a band and on all axes at once,
/// what came.
class NewestScores {
 public:
  explicit NewestScores(std::size_t capacity) : capacity_(capacity) {}
  void add(float score);
  [[nodiscard]] double size() const { return static_cast<double>(sorted_.size()); }
  /// How many are larger than q.
  [[nodiscard]] double count_above(double q) const;

 private:
  std::size_t capacity_;
  std::vector<float> newest_;  // a ring
  std::size_t oldest_ = 0;
  std::vector<float> sorted_;
};

using PerLevel = std::array<PerBand<double>, kConfidenceLevels.size()>;

/// All classes and bands, for each level of confidence. A value: the same scores in the same order give the same
/// margins.
///
/// Three distributions stand one upon the other in each band (Y. W. Teh et al., "Hierarchical Dirichlet processes",
/// JASA 2006): the prior's of the class, the scores of all tracks, beside which the prior counts as kPriorWeight
/// scores, and the class's own, beside which those two count as kPoolWeight. So a flight's first seconds tell what all
/// its tracks are like, and the prior is hardly heard any more; a class with scores of its own goes by them. Scores of
/// spans that overlap are alike: one over the span t counts kScorePeriod/t.
///
/// Level c breaks allowed(c, k) of its promises by the end of band k. The margin of a band is the one that the share θ
/// of scores exceeds, and θ follows what became of promises at that level (adaptive conformal inference, on log θ so
/// that rare and frequent misses are learnt alike): log θ ← log θ + kAdaption (allowed − 1[broken by the end of the
/// band]). So the share that is broken tends to what is allowed, whatever the scores' distribution does.
class Calibration {
 public:
  static constexpr std::size_t kOwnScores = 800, kPoolScores = 1600;
  static constexpr double kPriorWeight = 30.0, kPoolWeight = 30.0;
  static constexpr double kAdaption = 0.2;
  /// At the lower confidences θ begins with this part of the prior's: how fast things are in this world some ten scores
  /// tell, and until then little is made of not being sure.
  static constexpr double kInitialLevel = 0.25;
  /// θ/allowed stays within these.
  static constexpr double kMinLevel = 0.1, kMaxLevel = 2.0;

  /// @param confidence of level 0, in (0, 1)
  explicit Calibration(double confidence);
  /// Of all promises of a level, the share that may be broken by the end of a band: rises to 1 − its confidence at the
  /// horizon.
  [[nodiscard]] double allowed(std::size_t level, std::size_t band) const;
  /// For how many independent scores one of a band counts: (0, 1].
  [[nodiscard]] static double score_weight(std::size_t band);
  [[nodiscard]] const PerLevel& margins(TrackClass kind) const {
    return classes_[static_cast<std::size_t>(kind)].margins;
  }
  /// Of tracks of which only the share `real` exists: what does not exist breaks no promise. O(halvings · log scores).
  [[nodiscard]] PerLevel margins(TrackClass kind, double real_share) const;
  /// For how many independent scores those of the class's pool count: below kPriorWeight the prior counts more.
  [[nodiscard]] double evidence(TrackClass kind, std::size_t band) const {
    return score_weight(band) * pools_[pool_of(kind)][band].size();
  }
  /// Another prior rules from the next refresh() on. Scores stay; θ begins anew: that one prior was too wide says
  /// nothing of the other.
  void set_scene_speed(SceneSpeed scene_speed);
  /// Counts from the next refresh() on.
  /// @param broken  by level: whether the promise that was made had been broken by the end of the band
  /// @param made_in  what ruled when it was made: another prior's promises teach θ nothing
  void add(TrackClass kind, std::size_t band, float score, const std::array<bool, kConfidenceLevels.size()>& missed,
           SceneSpeed made_under);
  [[nodiscard]] SceneSpeed scene_speed() const { return scene_speed_; }
  /// margins() by all that was added.
  void refresh();

 private:
  struct Class {
    std::vector<NewestScores> scores;  // by band; none where the class is all of its pool
    PerLevel log_theta, margins;
  };
  void begin(SceneSpeed scene_speed);
  /// The least q that at most the share `level` of the class's scores exceeds.
  [[nodiscard]] double margin(TrackClass kind, std::size_t band, double level) const;

  std::array<double, kConfidenceLevels.size()> confidence_;
  SceneSpeed scene_speed_ = SceneSpeed::Any;
  std::array<std::vector<NewestScores>, kPools> pools_;  // by band
  std::array<Class, kTrackClasses> classes_;
  std::array<bool, kPools> is_stale_;
};

/// Half-width of the promise per axis so long after the last detection, m.
Vec3 interval_half_width(const Vec3& deviation, const PerBand<double>& margins, double ahead_s);

/// The least q of the band that contains this error, per axis, at this time. @pre deviation > 0
double covering_margin(const Vec3& error, const Vec3& deviation, std::size_t band, double ahead_s);

}  // namespace tern
