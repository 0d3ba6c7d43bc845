// How far what was predicted came out: split-conformal margins per class of track and horizon, adapted while flying.
// J. Lei et al., "Distribution-free predictive inference for regression", JASA 2018; I. Gibbs, E. Candès, "Adaptive
// conformal inference under distribution shift", NeurIPS 2021.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

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
};
inline constexpr std::size_t kTrackClasses = 8;
inline constexpr double kYoungAge = 0.3;  ///< s
inline constexpr double kGrownAge = 1.0;  ///< s

/// Margins hold up to so many seconds after a track was seen last; bands of time lie between.
inline constexpr std::array<double, 5> kBandEnds{0.25, 0.5, 1.0, 2.0, 4.5};
inline constexpr std::size_t kBands = kBandEnds.size();
template <typename T>
using PerBand = std::array<T, kBands>;

/// Half-width of a promise: kModelSigmas σ(t) of the model and a margin q g(t), which may be negative. Of the model's
/// share at least kLeastSigmas σ(t) remain.
inline constexpr double kModelSigmas = 2.0;
inline constexpr double kLeastSigmas = 1.0;
/// g(t) = (t + kMarginStart)/(end of the band + kMarginStart): errors grow with time.
inline constexpr double kMarginStart = 0.1;
std::size_t band_of(double ahead_s);  ///< the last one beyond its end
double margin_growth(std::size_t band, double ahead_s);

/// Scores of one class and band, the newest kWindow of them, and the level that makes the promise true.
///
/// The score of a prediction is the least q that would have contained, at all times of the band and on all axes at
/// once, what came: max over them of (|error| − kModelSigmas σ)/g. The margin at level θ is the ⌈(n + 1)(1 − θ)⌉-th
/// least of n scores. θ follows what was missed: θ ← θ + γ(ε − 1[missed by the end of the band]), so that the share of
/// missed promises tends to ε whatever the scores' distribution does.
class BandScores {
 public:
  static constexpr std::size_t kWindow = 800;
  static constexpr double kAdaption = 0.001;  ///< γ
  static constexpr double kLargestLevel = 0.2, kLeastLevel = 1e-3;

  /// @param scores the prior's, oldest first; @param level θ.
  BandScores(std::vector<float> scores, double level);
  void add(float score, bool missed, double epsilon);
  /// The margin at θ·ratio (a ladder of confidences asks with ratio > 1): the largest score where that level needs
  /// more scores than there are.
  [[nodiscard]] double margin(double ratio) const;
  [[nodiscard]] double level() const { return level_; }
  [[nodiscard]] const std::vector<float>& sorted() const { return sorted_; }

 private:
  std::vector<float> newest_;  // a ring
  std::size_t oldest_ = 0;
  std::vector<float> sorted_;
  double level_;
};

/// All classes and bands. A value: the same scores in the same order give the same margins.
class Calibration {
 public:
  explicit Calibration(double confidence);
  /// Promises broken by the end of band k, as a share: rises to 1 − confidence at the horizon.
  [[nodiscard]] double allowed(std::size_t band) const { return allowed_[band]; }
  [[nodiscard]] PerBand<double> margins(TrackClass kind, double ratio = 1.0) const;
  void add(TrackClass kind, std::size_t band, float score, bool missed);
  [[nodiscard]] const BandScores& scores(TrackClass kind, std::size_t band) const {
    return scores_[static_cast<std::size_t>(kind)][band];
  }

 private:
  PerBand<double> allowed_;
  std::array<std::vector<BandScores>, kTrackClasses> scores_;
};

}  // namespace tern
