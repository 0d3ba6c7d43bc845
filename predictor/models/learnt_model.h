// A motion model that is fitted during the flight to the flight's own tracks.
// Derivation: docs/prediction/learnt_model.md.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/types.h"
#include "predictor/models/model_bank.h"

namespace tern {

/// The times ahead, s, at which the model is fitted. A spline joins them.
inline constexpr std::array<double, 9> kLearntAhead{0.25, 0.375, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0};
inline constexpr std::size_t kLearntTimes = kLearntAhead.size();
/// The least ages of the groups of tracks, s. Each group has a regression of its own, because the state of a young
/// track is uncertain.
inline constexpr std::array<double, 4> kLearntAges{0.3, 0.5, 0.7, 0.9};
inline constexpr std::size_t kLearntGroups = kLearntAges.size();
/// Returns the group of a track of this age, or nullopt below the first age.
std::optional<std::size_t> learnt_group(double age_s);

/// Index of the bank's model whose filter supplies the features. It remembers one to two seconds.
inline constexpr std::size_t kFeatureModel = 13;
/// The features of one axis are s_i − u_i s_0 for i ≥ 1, with the filter's state s and its MotionModel::shift u. They
/// do not depend on the absolute position: velocity, acceleration, …, and last the offset of the centre that the
/// motion is about.
inline constexpr Eigen::Index kFeaturesPerAxis = kOrders[kFeatureModel] - 1;
inline constexpr Eigen::Index kFeatures = 3 * kFeaturesPerAxis;
using Features = Eigen::Matrix<double, kFeatures, 1>;
using FeatureCoefficients = Eigen::Matrix<double, kFeatures, 3>;  ///< an axis of W per column

/// The regressors of one track, taken at its last detection.
struct LearntInput {
  Vec3 position = Vec3::Zero();  ///< W, m
  Features features = Features::Zero();
};
LearntInput learnt_input(const BankFilter& bank);

/// The fitted coefficients for one time after the last detection.
struct LearntCoefficients {
  double ahead_s = 0.0;
  FeatureCoefficients position = FeatureCoefficients::Zero();  ///< W(h), m per feature
  FeatureCoefficients velocity = FeatureCoefficients::Zero();  ///< dW/dh
  Vec3 variance = Vec3::Zero();                                ///< v(h) of the group's tracks, m²
};
/// Returns the prediction p + h v + W(h)ᵀ x of one track, with the variance v(h).
FilterPrediction learnt_prediction(const LearntCoefficients& coefficients, const LearntInput& track);

/// Bayesian linear regression of future positions on the features of all three axes:
///   p(t + h) = p + h v + W(h)ᵀ x + ε.
/// Obstacles that move alike share one W(h). On a circle, for example, velocity and acceleration determine the future
/// position for every centre and phase; a model of single axes cannot express that.
///
/// Each group of ages has a W at the times kLearntAhead and a cubic spline between them. Let y be the observed
/// offset from the constant-velocity prediction p + h v. Then
///   W = (A_0 + S/u)⁻¹ (A_0 W_0 + m/u),   S = Σ w x xᵀ,   m = Σ w x yᵀ.
/// - S and m are the sufficient statistics. All samples of the next older group enter them with the weight of at most
///   20 samples (a pseudo-count).
/// - w is the sample's weight. It falls with the size of the residual, as for Student's t with 4 degrees of freedom.
/// - W_0 is the prediction of the filter itself. A_0 is its precision, by the size of the terms of Taylor's series.
/// - u is the mean square of the newest residuals, each taken before its sample entered S and m.
/// - v(h) is u per axis, minus the variance of the observed position. Once the group has enough samples, u and v use
///   only the residuals since then.
///
/// A value: the same samples in the same order give the same model. refit() solves a system of kFeatures unknowns per
/// group and per time ahead that has new samples.
class LearntModel {
 public:
  LearntModel();

  /// Returns how far ahead the model may be used for the group, s: up to the first time that lacks samples or
  /// residuals. 0: not at all.
  [[nodiscard]] double horizon_s(std::size_t group) const;
  /// Returns the coefficients at a time ahead. Beyond the last of kLearntAhead, W is extrapolated linearly, and v grows
  /// with the square of time. @param ahead_s ≥ 0
  [[nodiscard]] LearntCoefficients at(double ahead_s, std::size_t group) const;
  /// Adds a sample. It takes effect at the next refit().
  /// @param horizon  index of kLearntAhead
  /// @param observed  the track's position at that time, W, m; @param r its variance, m²
  /// @param weight  the number of independent samples that it is worth, (0, 1]
  void add_sample(std::size_t horizon, std::size_t group, const LearntInput& track, const Vec3& observed, const Vec3& r,
                  double weight);
  void refit();

 private:
  // The sufficient statistics of one group and time ahead.
  struct Statistics {
    Eigen::Matrix<double, kFeatures, kFeatures> gram = Eigen::Matrix<double, kFeatures, kFeatures>::Zero();  // S
    FeatureCoefficients moment = FeatureCoefficients::Zero();                                                // m
    double count = 0.0;
  };
  struct Residual {
    Vec3 square, observation_variance;  // m²
  };
  struct Residuals {
    std::vector<Residual> newest;  // a ring
    std::size_t oldest = 0;
    Vec3 variance = Vec3::Zero();  // v
    double mean_square = 1.0;      // u, over all axes
    bool are_of_fitted = false;    // made by a W of enough samples
  };
  // A knot of the spline, at 0 or at one of kLearntAhead.
  struct Knot {
    FeatureCoefficients value = FeatureCoefficients::Zero(), second_derivative = FeatureCoefficients::Zero();
  };
  struct Group {
    std::array<Statistics, kLearntTimes> statistics;
    std::array<Residuals, kLearntTimes> residuals;
    std::array<Knot, kLearntTimes + 1> knots;
    std::array<bool, kLearntTimes> has_enough_samples{};  // those of older groups included
  };
  struct Prior {
    Features precision;                                      // A_0
    FeatureCoefficients mean = FeatureCoefficients::Zero();  // W_0
  };
  std::array<Group, kLearntGroups> groups_;
  std::array<Prior, kLearntTimes> priors_;
  std::array<bool, kLearntTimes> is_stale_;
};

}  // namespace tern
