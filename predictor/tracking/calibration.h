// Calibrates prediction intervals: split-conformal margins per class of track, horizon and level of confidence, adapted
// during the flight. Steps 7 and 8 of docs/prediction.md.
// J. Lei et al., "Distribution-free predictive inference for regression", JASA 2018; I. Gibbs, E. Candès, "Adaptive
// conformal inference under distribution shift", NeurIPS 2021.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/base/types.h"
#include "core/world/track.h"
#include "core/world/track_class.h"
#include "predictor/tracking/calibration_prior.h"

namespace tern {

/// The classes with margins of their own, in the order of the prior's table, and the pool of each. Classes of one pool
/// share their scores. The three old classes of the bank's models are one pool; most flights see mostly those. Every
/// other class is a pool of its own. A young track's motion says little about its kind, and the learnt model, whatever
/// the age of its tracks, has its own errors.
struct CalibratedClass {
  TrackClass of;
  std::size_t pool;
};
inline constexpr std::size_t kPools = 7, kPoolOfOld = 6;
inline constexpr std::array<CalibratedClass, 9> kCalibratedClasses{{
    {kNewTrack, 0},
    {kYoungTrack, 1},
    {{TrackAge::Grown, MotionKind::Steady}, 2},
    {{TrackAge::Old, MotionKind::Steady}, kPoolOfOld},
    {{TrackAge::Grown, MotionKind::Calm}, 3},
    {{TrackAge::Old, MotionKind::Calm}, kPoolOfOld},
    {{TrackAge::Grown, MotionKind::Lively}, 4},
    {{TrackAge::Old, MotionKind::Lively}, kPoolOfOld},
    {{TrackAge::Old, MotionKind::Learnt}, 5},
}};
inline constexpr std::size_t kClasses = kCalibratedClasses.size();
/// Returns the index into kCalibratedClasses.
/// @pre not at rest: stationary tracks have a bound of their own (rest_record.h)
constexpr std::size_t class_index(TrackClass of) {
  if (of.motion == MotionKind::Learnt) return kClasses - 1;
  std::size_t k = 0;
  while (kCalibratedClasses[k].of != of) ++k;
  return k;
}

/// Each band ends at one of kCoverageHorizons, s after the last detection, and has its own margins.
inline constexpr std::size_t kBands = kHorizons;
template <typename T>
using PerBand = std::array<T, kBands>;

/// The half-width of an interval at the time t follows from the margin q. It is
///   (kModelSigmas + q g(t)) σ(t)   for −kModelSigmas ≤ q ≤ 0,
///   kModelSigmas σ(t) + q g(t)     for q > 0, in metres.
///
/// A negative margin scales the model's σ; a positive one adds errors that the model does not know. The half-width may
/// fall with t, so its users take the running maximum.
inline constexpr double kModelSigmas = 2.0;
/// g(t) = (t + kMarginStart)/(end of the band + kMarginStart), because errors grow with time.
inline constexpr double kMarginStart = 0.1;
std::size_t band_of(double ahead_s);  ///< beyond the last band: the last one
double margin_growth(std::size_t band, double ahead_s);

/// The newest scores, up to a capacity. The score of a prediction is the least margin q whose interval would have
/// covered at all times of a band, on all axes.
class NewestScores {
 public:
  explicit NewestScores(std::size_t capacity) : capacity_(capacity) {}
  void add(float score);
  [[nodiscard]] double size() const { return static_cast<double>(sorted_.size()); }
  /// The number of scores above q.
  [[nodiscard]] double count_above(double q) const;

 private:
  std::size_t capacity_;
  std::vector<float> newest_;  // a ring
  std::size_t oldest_ = 0;
  std::vector<float> sorted_;
};

using PerLevel = std::array<PerBand<double>, kConfidenceLevels.size()>;

/// The margins of all classes, bands and levels of confidence.
///
/// The distribution of scores is a hierarchy (Y. W. Teh et al., "Hierarchical Dirichlet processes", JASA 2006):
/// 1. the prior of the class, which counts as kPriorWeight scores;
/// 2. the scores of the pool, which with the prior count as kPoolWeight scores;
/// 3. the scores of the class itself.
/// So the prior rules the first seconds, and a class with enough scores is ruled by its own. A score over the span t
/// has the weight kScorePeriod/t, because overlapping spans are correlated.
///
/// The margin is the least q that at most the share θ of scores exceeds. θ is adapted so that level c misses the share
/// allowed(c, band), whatever the distribution of scores (adaptive conformal inference). On log θ, rare and frequent
/// misses are learnt equally fast:
///   log θ ← log θ + kAdaption (allowed − 1[missed by the end of the band]).
///
/// A value: the same scores in the same order give the same margins.
class Calibration {
 public:
  static constexpr std::size_t kOwnScores = 800, kPoolScores = 1600;
  static constexpr double kPriorWeight = 30.0, kPoolWeight = 30.0;
  static constexpr double kAdaption = 0.2;
  /// At lower levels θ begins with this fraction of the prior's θ. Some ten scores later it has adapted to the scene.
  static constexpr double kInitialLevel = 0.25;
  /// Bounds of θ/allowed.
  static constexpr double kMinLevel = 0.1, kMaxLevel = 2.0;

  /// @param confidence of level 0, in (0, 1)
  explicit Calibration(double confidence);
  /// Returns the allowed miss rate of a level up to the end of a band. It rises to 1 − its confidence at the horizon.
  [[nodiscard]] double allowed(std::size_t level, std::size_t band) const;
  /// Returns the number of independent scores that one score of a band is worth, (0, 1].
  [[nodiscard]] static double score_weight(std::size_t band);
  [[nodiscard]] const PerLevel& margins(TrackClass of) const { return classes_[class_index(of)].margins; }
  /// Returns the margins for tracks of which only the share `real_share` exists. A false alarm is never missed, so θ is
  /// divided by that share. O(halvings · log scores).
  [[nodiscard]] PerLevel margins(TrackClass of, double real_share) const;
  /// Returns the number of independent scores in the class's pool. Below kPriorWeight the prior outweighs them.
  [[nodiscard]] double evidence(TrackClass of, std::size_t band) const {
    return score_weight(band) * pools_[kCalibratedClasses[class_index(of)].pool][band].size();
  }
  /// Selects the prior, from the next refresh() on. A change keeps the scores, and resets θ to that of the new prior.
  void set_scene_speed(SceneSpeed scene_speed);
  /// Adds a score. It takes effect at the next refresh().
  /// @param missed  by level: whether the interval missed by the end of the band
  /// @param made_under  the prior when the prediction was made; θ learns only under the present one
  void add(TrackClass track, std::size_t band, float score, const std::array<bool, kConfidenceLevels.size()>& missed,
           SceneSpeed made_under);
  [[nodiscard]] SceneSpeed scene_speed() const { return scene_speed_; }
  /// Recomputes margins() of the pools with new scores.
  void refresh();

 private:
  struct Class {
    std::vector<NewestScores> scores;  // by band; empty if the class is a pool of its own
    PerLevel log_theta, margins;
  };
  void begin(SceneSpeed scene_speed);
  /// Returns the least q that at most the share θ of the class's scores exceeds. @param k  class_index()
  [[nodiscard]] double margin(std::size_t k, std::size_t band, double theta) const;
  [[nodiscard]] PerLevel margins(std::size_t k, double real_share) const;

  std::array<double, kConfidenceLevels.size()> confidence_;
  SceneSpeed scene_speed_ = SceneSpeed::Any;
  std::array<std::vector<NewestScores>, kPools> pools_;  // by band
  std::array<Class, kClasses> classes_;
  std::array<bool, kPools> is_stale_;
};

/// Returns the half-width per axis at a time after the last detection, m.
Vec3 interval_half_width(const Vec3& deviation, const PerBand<double>& margins, double ahead_s);

/// Returns the least margin of the band whose interval covers this error at this time. @pre deviation > 0
double covering_margin(const Vec3& error, const Vec3& deviation, std::size_t band, double ahead_s);

}  // namespace tern
