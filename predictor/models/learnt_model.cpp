#include "predictor/models/learnt_model.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace tern {
namespace {

// So many lessons are enough to begin with, and so many errors to judge a group by.
constexpr double kFewestLessons = 15.0;
constexpr std::size_t kFewestErrors = 5;
// All lessons of the next older group count as so many.
constexpr double kLent = 20.0;
// W forgets after so many independent lessons, v after so many errors.
constexpr double kLessonsKept = 500.0;
constexpr std::size_t kErrorsKept = 40;
constexpr double kDegrees = 4.0;
constexpr double kLeastLearntVariance = 1e-6;  // m²

// How large W may be: what Taylor's series makes of derivatives; 1 for the place that the motion is about.
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

Vec3 velocity_of(const LearntFrom& track) {
  const Features& x = track.features;
  return {x[0], x[kFeaturesPerAxis], x[2 * kFeaturesPerAxis]};
}

Vec3 straight_on(const LearntFrom& track, double ahead_s) { return track.position + ahead_s * velocity_of(track); }

constexpr int kKnots = static_cast<int>(kLearntTimes) + 1;
constexpr double knot_at(int k) { return k == 0 ? 0.0 : kLearntAhead[idx(k - 1)]; }

// Second derivatives at the knots of the cubic spline whose slope is 0 at the first and which ends straight: a linear
// map of its values. C. de Boor, "A practical guide to splines", 1978, ch. IV.
const Eigen::Matrix<double, kKnots, kKnots>& bends_of_values() {
  static const Eigen::Matrix<double, kKnots, kKnots> map = [] {
    Eigen::Matrix<double, kKnots, kKnots> bends = Eigen::Matrix<double, kKnots, kKnots>::Zero(), values = bends;
    for (int k = 0; k + 1 < kKnots; ++k) {
      const double length = knot_at(k + 1) - knot_at(k);
      for (const auto& [row, sign] : {std::pair{k, 1.0}, std::pair{k + 1, -1.0}}) {
        bends(row, row) += length / 3.0;
        bends(row, row == k ? k + 1 : k) += length / 6.0;
        values(row, k) -= sign / length;
        values(row, k + 1) += sign / length;
      }
    }
    bends.row(kKnots - 1).setZero();
    values.row(kKnots - 1).setZero();
    bends(kKnots - 1, kKnots - 1) = 1.0;
    return Eigen::Matrix<double, kKnots, kKnots>(bends.inverse() * values);
  }();
  return map;
}

}  // namespace

std::optional<std::size_t> learnt_group(double age_s) {
  const auto next = std::ranges::upper_bound(kLearntAges, age_s);
  if (next == kLearntAges.begin()) return std::nullopt;
  return idx(next - kLearntAges.begin()) - 1;
}

LearntFrom learnt_from(const BankFilter& bank) {
  const ModelVector& shift = motion_models()[kLearntFrom].shift;
  const MotionFilter filter = bank.of(kLearntFrom);
  LearntFrom track;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Map<const Eigen::Matrix<double, kFeaturesPerAxis + 1, 1>> mean(filter.mean(axis));
    track.position[axis] = mean[0];
    track.features.segment<kFeaturesPerAxis>(axis * kFeaturesPerAxis) =
        mean.tail<kFeaturesPerAxis>() - mean[0] * shift.tail<kFeaturesPerAxis>();
  }
  return track;
}

FilterLook said_by(const LearntLook& look, const LearntFrom& track) {
  return {straight_on(track, look.ahead_s) + look.position.transpose() * track.features,
          velocity_of(track) + look.velocity.transpose() * track.features, look.variance};
}

LearntModel::LearntModel() {
  for (std::size_t h = 0; h < kLearntTimes; ++h) {
    const ModelMatrix phi = model_step(motion_models()[kLearntFrom], kLearntAhead[h]).phi;
    priors_[h].precision = scale_at(kLearntAhead[h]).cwiseAbs2().cwiseInverse();
    for (int axis = 0; axis < 3; ++axis) {
      auto own = priors_[h].weights.col(axis).segment<kFeaturesPerAxis>(axis * kFeaturesPerAxis);
      own = phi.row(0).tail<kFeaturesPerAxis>().transpose();
      own[0] -= kLearntAhead[h];
    }
  }
  is_stale_.fill(true);
  refresh();
}

double LearntModel::known_to(std::size_t group) const {
  double ahead_s = 0.0;
  for (std::size_t h = 0; h < kLearntTimes; ++h) {
    if (groups_.back().lessons[h].count < kFewestLessons) break;
    if (groups_[group].errors[h].newest.size() < kFewestErrors) break;
    ahead_s = kLearntAhead[h];
  }
  return ahead_s;
}

void LearntModel::learn(std::size_t horizon, std::size_t group, const LearntFrom& track, const Vec3& came,
                        const Vec3& r, double worth) {
  Group& of = groups_[group];
  Errors& errors = of.errors[horizon];
  if (of.is_taught[horizon] && !errors.are_of_taught) {
    errors = {};
    errors.are_of_taught = true;
  }
  const Features& x = track.features;
  const Vec3 y = came - straight_on(track, kLearntAhead[horizon]);
  const Eigen::Array3d error2 = (y - of.knots[horizon + 1].value.transpose() * x).array().square();
  double trust = 1.0;
  if (!errors.newest.empty()) {
    trust = (kDegrees + 3.0) / (kDegrees + (error2 / (errors.variance + r).array()).sum());
  }
  if (errors.newest.size() < kErrorsKept) errors.newest.emplace_back();
  errors.newest[errors.oldest] = {trust * error2, r};
  errors.oldest = (errors.oldest + 1) % kErrorsKept;
  Vec3 square = Vec3::Zero(), of_truth = Vec3::Zero();
  for (const Wrong& wrong : errors.newest) {
    square += wrong.square;
    of_truth += wrong.of_truth;
  }
  const auto count = static_cast<double>(errors.newest.size());
  errors.variance = ((square - of_truth) / count).cwiseMax(kLeastLearntVariance);
  errors.all = std::max(kLeastLearntVariance, square.mean() / count);

  Lessons& lessons = of.lessons[horizon];
  const double weight = worth * trust;
  const double kept = 1.0 - worth / kLessonsKept;
  lessons.gram = kept * lessons.gram + weight * x * x.transpose();
  lessons.moment = kept * lessons.moment + weight * x * y.transpose();
  lessons.count = kept * lessons.count + 1.0;
  is_stale_[horizon] = true;
}

void LearntModel::refresh() {
  for (std::size_t h = 0; h < kLearntTimes; ++h) {
    if (!is_stale_[h]) continue;
    Lessons all;
    double wrong = 1.0;  // u; an age that nothing was judged of takes the next older one's
    for (std::size_t group = kLearntGroups; group-- > 0;) {
      const Lessons& own = groups_[group].lessons[h];
      if (own.count > 0.0) wrong = groups_[group].errors[h].all;
      const double lent = all.count > kLent ? kLent / all.count : 1.0;
      all.gram = lent * all.gram + own.gram;
      all.moment = lent * all.moment + own.moment;
      all.count = lent * all.count + own.count;
      Eigen::Matrix<double, kFeatures, kFeatures> a = all.gram / wrong;
      a.diagonal() += priors_[h].precision;
      groups_[group].is_taught[h] = all.count >= kFewestLessons;
      groups_[group].knots[h + 1].value =
          a.llt().solve(all.moment / wrong + priors_[h].precision.asDiagonal() * priors_[h].weights);
    }
    is_stale_[h] = false;
  }
  for (Group& group : groups_) {
    for (int k = 0; k < kKnots; ++k) {
      FeatureWeights& bend = group.knots[idx(k)].bend;
      bend.setZero();
      for (int j = 1; j < kKnots; ++j) bend += bends_of_values()(k, j) * group.knots[idx(j)].value;
    }
  }
}

LearntLook LearntModel::at(double ahead_s, std::size_t group) const {
  const auto next = std::ranges::lower_bound(kLearntAhead.begin(), kLearntAhead.end() - 1, ahead_s);
  const auto k = idx(next - kLearntAhead.begin());
  const Group& of = groups_[group];
  const Knot &from = of.knots[k], &to = of.knots[k + 1];
  const double begin = knot_at(static_cast<int>(k)), length = kLearntAhead[k] - begin;
  const double u = (std::min(ahead_s, kLearntAhead.back()) - begin) / length, w = 1.0 - u;
  LearntLook look;
  look.ahead_s = ahead_s;
  look.position =
      w * from.value + u * to.value + length * length / 6.0 * ((w * w * w - w) * from.bend + (u * u * u - u) * to.bend);
  look.velocity = (to.value - from.value) / length +
                  length / 6.0 * ((1.0 - 3.0 * w * w) * from.bend + (3.0 * u * u - 1.0) * to.bend);
  look.variance = w * of.errors[k == 0 ? 0 : k - 1].variance + u * of.errors[k].variance;
  if (ahead_s > kLearntAhead.back()) {
    look.position += (ahead_s - kLearntAhead.back()) * look.velocity;
    look.variance *= std::pow(ahead_s / kLearntAhead.back(), 2);
  }
  return look;
}

}  // namespace tern
