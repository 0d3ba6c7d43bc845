// A motion model that is learnt from the flight's own tracks, in which each axis looks at all three.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/types.h"
#include "predictor/models/model_bank.h"

namespace tern {

/// It is learnt at these times ahead, s, and holds between them and up to the last.
inline constexpr std::array<double, 9> kLearntAhead{0.25, 0.375, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0};
inline constexpr std::size_t kLearntTimes = kLearntAhead.size();
/// It is learnt apart for tracks that have been seen so long, s: of what was seen for a moment, the state is hardly
/// known.
inline constexpr std::array<double, 4> kLearntAges{0.3, 0.5, 0.7, 0.9};
inline constexpr std::size_t kLearntGroups = kLearntAges.size();
std::optional<std::size_t> learnt_group(double age_s);

/// What it goes by is the state of this filter of the bank: a second or two of the past.
inline constexpr std::size_t kLearntFrom = 13;
/// Per axis the states s_i − u_i s_0, i ≥ 1, which are the same wherever the thing is: velocity, acceleration, …, and
/// last how far off the place lies that the motion is about.
inline constexpr Eigen::Index kFeaturesPerAxis = kOrders[kLearntFrom] - 1;
inline constexpr Eigen::Index kFeatures = 3 * kFeaturesPerAxis;
using Features = Eigen::Matrix<double, kFeatures, 1>;
using FeatureWeights = Eigen::Matrix<double, kFeatures, 3>;  ///< an axis per column

/// What the model goes by: a track at its last detection.
struct LearntFrom {
  Vec3 position = Vec3::Zero();  ///< W, m
  Features features = Features::Zero();
};
LearntFrom learnt_from(const BankFilter& bank);

/// The model at one time after the last detection.
struct LearntLook {
  double ahead_s = 0.0;
  FeatureWeights position = FeatureWeights::Zero();  ///< W(h), m per feature
  FeatureWeights velocity = FeatureWeights::Zero();  ///< dW/dh
  Vec3 variance = Vec3::Zero();                      ///< v(h) of tracks of one group, m²
};
FilterLook said_by(const LearntLook& look, const LearntFrom& track);

/// Where things move alike, one law tells where they go: p(t + h) = p + h v + W(h)ᵀ x + ε, with the features x of all
/// three axes. On a circle, for one, velocity and acceleration tell all, whatever its centre and phase.
///
/// W is a Bayesian linear regression over all tracks of one group of age at the times kLearntAhead, and a cubic spline
/// between: with y what came beyond p + h v,
///   W = (A_0 + S/u)⁻¹ (A_0 W_0 + m/u),  S = Σ w x xᵀ,  m = Σ w x yᵀ,  w less where y surprises (Student's t).
/// In S and m, all lessons of the next older group count as kLent. W_0 is what the filter itself predicts, give or take
/// what features contribute by Taylor's series (A_0). u is the mean square of what was wrong with the newest
/// predictions, before W learnt from them; v(h) the same without what was wrong with the truth. Once W has been taught,
/// these are the predictions that it made since.
///
/// A value: the same lessons in the same order teach the same.
class LearntModel {
 public:
  LearntModel();

  /// So far ahead, s, it was taught enough, and judged by enough tracks of the group; 0: nowhere.
  [[nodiscard]] double known_to(std::size_t group) const;
  /// Beyond kLearntAhead the spline goes on straight, and v grows like the square of time. @param ahead_s ≥ 0
  [[nodiscard]] LearntLook at(double ahead_s, std::size_t group) const;
  /// Counts from the next refresh() on.
  /// @param horizon  index of kLearntAhead; @param came  where the track was then, W, m; @param r its variance, m²
  /// @param worth  for how many independent lessons it counts, (0, 1]
  void learn(std::size_t horizon, std::size_t group, const LearntFrom& track, const Vec3& came, const Vec3& r,
             double worth);
  void refresh();

 private:
  struct Lessons {
    Eigen::Matrix<double, kFeatures, kFeatures> gram = Eigen::Matrix<double, kFeatures, kFeatures>::Zero();  // S
    FeatureWeights moment = FeatureWeights::Zero();                                                          // m
    double count = 0.0;
  };
  struct Wrong {
    Vec3 square, of_truth;
  };
  struct Errors {
    std::vector<Wrong> newest;  // a ring
    std::size_t oldest = 0;
    Vec3 variance = Vec3::Zero();  // v
    double all = 1.0;              // u, over all axes
    bool are_of_taught = false;    // else of a W that few had taught anything
  };
  // The spline's, at 0 and kLearntAhead.
  struct Knot {
    FeatureWeights value = FeatureWeights::Zero(), bend = FeatureWeights::Zero();  // W, W″
  };
  struct Group {
    std::array<Lessons, kLearntTimes> lessons;
    std::array<Errors, kLearntTimes> errors;
    std::array<Knot, kLearntTimes + 1> knots;
    std::array<bool, kLearntTimes> is_taught{};  // by kFewestLessons, its own and lent ones
  };
  struct Prior {
    Features precision;                               // A_0
    FeatureWeights weights = FeatureWeights::Zero();  // W_0
  };
  std::array<Group, kLearntGroups> groups_;
  std::array<Prior, kLearntTimes> priors_;
  std::array<bool, kLearntTimes> is_stale_;
};

}  // namespace tern
