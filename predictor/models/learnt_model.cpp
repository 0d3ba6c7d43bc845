#include "predictor/models/learnt_model.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace tern {
namespace {

// A group may be used from so many samples and residuals on.
constexpr double kMinSamples = 15.0;
constexpr std::size_t kMinResiduals = 5;
// All samples of the next older group together enter with at most this weight.
constexpr double kPseudoCount = 20.0;
// W forgets with this memory, in independent samples; v is made of so many of the newest residuals.
constexpr double kSampleMemory = 500.0;
constexpr std::size_t kMaxResiduals = 40;
constexpr double kDegreesOfFreedom = 4.0;      // of Student's t
constexpr double kMinResidualVariance = 1e-6;  // m²

// The size that entries of W may have: h^i/i! for the i-th derivative (Taylor's series), 1 for the offset of the
// centre.
Features scale_at(double ahead_s) {
  Features scale;
  for (int axis = 0; axis < 3; ++axis) {
    double term = 1.0;
    for (int i = 0; i < kFeaturesPerAxis; ++i) {
      term *= ahead_s / (i + 1);
      scale[axis * kFeaturesPerAxis + i] = i + 1 < kFeaturesPerAxis ? term : 1.0;
    }
  }
  return scale;
}

Vec3 velocity_of(const LearntInput& track) {
  const Features& x = track.features;
  return {x[0], x[kFeaturesPerAxis], x[2 * kFeaturesPerAxis]};
}

Vec3 constant_velocity_prediction(const LearntInput& track, double ahead_s) {
  return track.position + ahead_s * velocity_of(track);
}

constexpr int kKnots = static_cast<int>(kLearntTimes) + 1;
constexpr double knot_at(int k) { return k == 0 ? 0.0 : kLearntAhead[idx(k - 1)]; }

// The linear map from a spline's values at the knots to its second derivatives there. The cubic spline has slope 0 at
// the first knot and second derivative 0 at the last. C. de Boor, "A practical guide to splines", 1978, ch. IV.
const Eigen::Matrix<double, kKnots, kKnots>& second_derivatives_of_values() {
  static const Eigen::Matrix<double, kKnots, kKnots> map = [] {
    Eigen::Matrix<double, kKnots, kKnots> second_derivatives = Eigen::Matrix<double, kKnots, kKnots>::Zero(),
                                          values = second_derivatives;
    for (int k = 0; k + 1 < kKnots; ++k) {
      const double length = knot_at(k + 1) - knot_at(k);
      for (const auto& [row, sign] : {std::pair{k, 1.0}, std::pair{k + 1, -1.0}}) {
        second_derivatives(row, row) += length / 3.0;
        second_derivatives(row, row == k ? k + 1 : k) += length / 6.0;
        values(row, k) -= sign / length;
        values(row, k + 1) += sign / length;
      }
    }
    second_derivatives.row(kKnots - 1).setZero();
    values.row(kKnots - 1).setZero();
    second_derivatives(kKnots - 1, kKnots - 1) = 1.0;
    return Eigen::Matrix<double, kKnots, kKnots>(second_derivatives.inverse() * values);
  }();
  return map;
}

}  // namespace

std::optional<std::size_t> learnt_group(double age_s) {
  const auto next = std::ranges::upper_bound(kLearntAges, age_s);
  if (next == kLearntAges.begin()) return std::nullopt;
  return idx(next - kLearntAges.begin()) - 1;
}

LearntInput learnt_input(const BankFilter& bank) {
  const ModelVector& shift = motion_models()[kFeatureModel].shift;
  const MotionFilter filter = bank.of(kFeatureModel);
  LearntInput track;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Map<const Eigen::Matrix<double, kFeaturesPerAxis + 1, 1>> mean(filter.mean(axis));
    track.position[axis] = mean[0];
    track.features.segment<kFeaturesPerAxis>(axis * kFeaturesPerAxis) =
        mean.tail<kFeaturesPerAxis>() - mean[0] * shift.tail<kFeaturesPerAxis>();
  }
  return track;
}

FilterPrediction learnt_prediction(const LearntCoefficients& coefficients, const LearntInput& track) {
  return {
      constant_velocity_prediction(track, coefficients.ahead_s) + coefficients.position.transpose() * track.features,
      velocity_of(track) + coefficients.velocity.transpose() * track.features, coefficients.variance};
}

LearntModel::LearntModel() {
  for (std::size_t h = 0; h < kLearntTimes; ++h) {
    const ModelMatrix phi = model_step(motion_models()[kFeatureModel], kLearntAhead[h]).phi;
    priors_[h].precision = scale_at(kLearntAhead[h]).cwiseAbs2().cwiseInverse();
    for (int axis = 0; axis < 3; ++axis) {
      auto own = priors_[h].mean.col(axis).segment<kFeaturesPerAxis>(axis * kFeaturesPerAxis);
      own = phi.row(0).tail<kFeaturesPerAxis>().transpose();
      own[0] -= kLearntAhead[h];
    }
  }
  is_stale_.fill(true);
  refit();
}

double LearntModel::horizon_s(std::size_t group) const {
  double ahead_s = 0.0;
  for (std::size_t h = 0; h < kLearntTimes; ++h) {
    if (groups_.back().statistics[h].count < kMinSamples) break;
    if (groups_[group].residuals[h].newest.size() < kMinResiduals) break;
    ahead_s = kLearntAhead[h];
  }
  return ahead_s;
}

void LearntModel::add_sample(std::size_t horizon, std::size_t group, const LearntInput& track, const Vec3& observed,
                             const Vec3& r, double weight) {
  Group& of = groups_[group];
  Residuals& residuals = of.residuals[horizon];
  if (of.has_enough_samples[horizon] && !residuals.are_of_fitted) {
    residuals = {};
    residuals.are_of_fitted = true;
  }
  const Features& x = track.features;
  const Vec3 y = observed - constant_velocity_prediction(track, kLearntAhead[horizon]);
  const Eigen::Array3d residual2 = (y - of.knots[horizon + 1].value.transpose() * x).array().square();
  double robust_weight = 1.0;
  if (!residuals.newest.empty()) {
    robust_weight =
        (kDegreesOfFreedom + 3.0) / (kDegreesOfFreedom + (residual2 / (residuals.variance + r).array()).sum());
  }
  if (residuals.newest.size() < kMaxResiduals) residuals.newest.emplace_back();
  residuals.newest[residuals.oldest] = {robust_weight * residual2, r};
  residuals.oldest = (residuals.oldest + 1) % kMaxResiduals;
  Vec3 square = Vec3::Zero(), observation_variance = Vec3::Zero();
  for (const Residual& residual : residuals.newest) {
    square += residual.square;
    observation_variance += residual.observation_variance;
  }
  const auto count = static_cast<double>(residuals.newest.size());
  residuals.variance = ((square - observation_variance) / count).cwiseMax(kMinResidualVariance);
  residuals.mean_square = std::max(kMinResidualVariance, square.mean() / count);

  Statistics& statistics = of.statistics[horizon];
  const double w = weight * robust_weight;
  const double kept = 1.0 - weight / kSampleMemory;
  statistics.gram = kept * statistics.gram + w * x * x.transpose();
  statistics.moment = kept * statistics.moment + w * x * y.transpose();
  statistics.count = kept * statistics.count + 1.0;
  is_stale_[horizon] = true;
}

void LearntModel::refit() {
  for (std::size_t h = 0; h < kLearntTimes; ++h) {
    if (!is_stale_[h]) continue;
    Statistics all;
    double mean_square = 1.0;  // u; a group without samples takes that of the next older group
    for (std::size_t group = kLearntGroups; group-- > 0;) {
      const Statistics& own = groups_[group].statistics[h];
      if (own.count > 0.0) mean_square = groups_[group].residuals[h].mean_square;
      const double scale = all.count > kPseudoCount ? kPseudoCount / all.count : 1.0;
      all.gram = scale * all.gram + own.gram;
      all.moment = scale * all.moment + own.moment;
      all.count = scale * all.count + own.count;
      Eigen::Matrix<double, kFeatures, kFeatures> a = all.gram / mean_square;
      a.diagonal() += priors_[h].precision;
      groups_[group].has_enough_samples[h] = all.count >= kMinSamples;
      groups_[group].knots[h + 1].value =
          a.llt().solve(all.moment / mean_square + priors_[h].precision.asDiagonal() * priors_[h].mean);
    }
    is_stale_[h] = false;
  }
  for (Group& group : groups_) {
    for (int k = 0; k < kKnots; ++k) {
      FeatureCoefficients& second = group.knots[idx(k)].second_derivative;
      second.setZero();
      for (int j = 1; j < kKnots; ++j) second += second_derivatives_of_values()(k, j) * group.knots[idx(j)].value;
    }
  }
}

LearntCoefficients LearntModel::at(double ahead_s, std::size_t group) const {
  const auto next = std::ranges::lower_bound(kLearntAhead.begin(), kLearntAhead.end() - 1, ahead_s);
  const auto k = idx(next - kLearntAhead.begin());
  const Group& of = groups_[group];
  const Knot &from = of.knots[k], &to = of.knots[k + 1];
  const double begin = knot_at(static_cast<int>(k)), length = kLearntAhead[k] - begin;
  const double u = (std::min(ahead_s, kLearntAhead.back()) - begin) / length, w = 1.0 - u;
  LearntCoefficients coefficients;
  coefficients.ahead_s = ahead_s;
  coefficients.position =
      w * from.value + u * to.value +
      length * length / 6.0 * ((w * w * w - w) * from.second_derivative + (u * u * u - u) * to.second_derivative);
  coefficients.velocity =
      (to.value - from.value) / length +
      length / 6.0 * ((1.0 - 3.0 * w * w) * from.second_derivative + (3.0 * u * u - 1.0) * to.second_derivative);
  coefficients.variance = w * of.residuals[k == 0 ? 0 : k - 1].variance + u * of.residuals[k].variance;
  if (ahead_s > kLearntAhead.back()) {
    coefficients.position += (ahead_s - kLearntAhead.back()) * coefficients.velocity;
    coefficients.variance *= std::pow(ahead_s / kLearntAhead.back(), 2);
  }
  return coefficients;
}

}  // namespace tern
