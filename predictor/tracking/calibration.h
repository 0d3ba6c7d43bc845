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
#include "core/world/track_bounds.h"
#include "predictor/tracking/calibration_prior.h"

namespace tern {

/// The class of a track: its age, and the models that predict it best. Grown tracks are younger than kGrownAge, old
/// tracks are not.
enum class TrackClass {
  New,          ///< detected once
  Young,        ///< younger than kYoungAge: its speed is still unknown
  SteadyGrown,  ///< predicted best by steady models (model_bank.h)
  SteadyOld,    ///< the same, old
  CalmGrown,    ///< predicted best by calm models
  CalmOld,      ///< the same, old
  LivelyGrown,  ///< predicted best by lively models
  LivelyOld,    ///< the same, old
  Learnt,       ///< predicted best by the learnt model (learnt_model.h), of any age
};
inline constexpr std::size_t kTrackClasses = 9;
/// Classes of one pool share their scores. The three old classes of the bank's models are one pool; most flights see
/// mostly those. Every other class is a pool of its own. A young track's motion says little about its kind, and the
/// learnt model has its own errors.
inline constexpr std::size_t kPools = 7;
constexpr std::size_t pool_of(TrackClass kind) {
  const auto k = static_cast<std::size_t>(kind);
  if (kind == TrackClass::Learnt) return kPools - 2;
  return k < 2 ? k : k % 2 == 1 ? kPools - 1 : 1 + k / 2;
}
/// Returns the kind that TRACK_BOUNDS reports for a class.
constexpr MotionKind motion_kind_of(TrackClass of) {
  const auto k = static_cast<std::size_t>(of);
  return static_cast<MotionKind>(k < 2 ? k : 1 + k / 2);
}
inline constexpr double kYoungAge = 0.3;  ///< s
inline constexpr double kGrownAge = 1.0;  ///< s

/// The ends of the bands, s after the last detection. Each band has its own margins.
inline constexpr std::array<double, 5> kBandEnds{0.25, 0.5, 1.0, 2.0, 4.5};
inline constexpr std::size_t kBands = kBandEnds.size();
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
  [[nodiscard]] const PerLevel& margins(TrackClass kind) const {
    return classes_[static_cast<std::size_t>(kind)].margins;
  }
  /// Returns the margins for tracks of which only the share `real_share` exists. A false alarm is never missed, so θ is
  /// divided by that share. O(halvings · log scores).
  [[nodiscard]] PerLevel margins(TrackClass kind, double real_share) const;
  /// Returns the number of independent scores in the class's pool. Below kPriorWeight the prior outweighs them.
  [[nodiscard]] double evidence(TrackClass kind, std::size_t band) const {
    return score_weight(band) * pools_[pool_of(kind)][band].size();
  }
  /// Selects the prior, from the next refresh() on. A change keeps the scores, and resets θ to that of the new prior.
  void set_scene_speed(SceneSpeed scene_speed);
  /// Adds a score. It takes effect at the next refresh().
  /// @param missed  by level: whether the interval missed by the end of the band
  /// @param made_under  the prior when the prediction was made; θ learns only under the present one
  void add(TrackClass kind, std::size_t band, float score, const std::array<bool, kConfidenceLevels.size()>& missed,
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
  /// Returns the least q that at most the share `level` of the class's scores exceeds.
  [[nodiscard]] double margin(TrackClass kind, std::size_t band, double level) const;

  std::array<double, kConfidenceLevels.size()> confidence_;
  SceneSpeed scene_speed_ = SceneSpeed::Any;
  std::array<std::vector<NewestScores>, kPools> pools_;  // by band
  std::array<Class, kTrackClasses> classes_;
  std::array<bool, kPools> is_stale_;
};

/// Returns the half-width per axis at a time after the last detection, m.
Vec3 interval_half_width(const Vec3& deviation, const PerBand<double>& margins, double ahead_s);

/// Returns the least margin of the band whose interval covers this error at this time. @pre deviation > 0
double covering_margin(const Vec3& error, const Vec3& deviation, std::size_t band, double ahead_s);

}  // namespace tern
