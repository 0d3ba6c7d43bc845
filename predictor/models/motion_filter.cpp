#include "predictor/models/motion_filter.h"

#include <algorithm>

namespace tern {
namespace {

template <int N>
void predict_covariance(ModelMatrix& covariance, const ModelStep& step) {
  using Matrix = Eigen::Matrix<double, N, N>;
  const Matrix phi = step.phi;
  const Matrix moved = phi * Matrix(covariance);
  covariance.noalias() = moved * phi.transpose() + Matrix(step.q);
}

void predict_any(ModelMatrix& covariance, const ModelStep& step) {
  switch (covariance.rows()) {
    case 2: return predict_covariance<2>(covariance, step);
    case 3: return predict_covariance<3>(covariance, step);
    case 4: return predict_covariance<4>(covariance, step);
    default: return predict_covariance<kMaxOrder>(covariance, step);
  }
}

void update_covariance(ModelMatrix& covariance, double r) {
  const ModelVector column = covariance.col(0);
  covariance.noalias() -= column * column.transpose() / (column[0] + r);
}

double variance_of(const ModelMatrix& covariance, const ModelLook& ahead) {
  const auto n = covariance.rows();
  double sum = ahead.variance;
  for (Eigen::Index j = 0; j < n; ++j) {
    double column = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) column += covariance(i, j) * ahead.position[i];
    sum += column * ahead.position[j];
  }
  return std::max(sum, 0.0);
}

}  // namespace

ModelLook look(const ModelStep& step) {
  return {step.phi.row(0).transpose(), step.phi.row(1).transpose(), step.q(0, 0)};
}

ModelLook look(const ModelStep& ahead, const ModelStep& first) {
  const ModelVector row = ahead.phi.row(0).transpose();
  return {first.phi.transpose() * row, first.phi.transpose() * ahead.phi.row(1).transpose(),
          ahead.q(0, 0) + row.dot(first.q * row)};
}

MotionFilter::MotionFilter(const MotionModel& model, const Vec3& z, const Vec3& r) {
  const Vec3 known = r.cwiseMax(kLeastVariance);
  mean_ = model.shift * z.transpose();
  const auto started = [&](double variance) -> ModelMatrix {
    return model.prior + variance * model.shift * model.shift.transpose();
  };
  first_ = started(known[0]);
  if (known[0] != known[1] || known[1] != known[2]) others_ = {started(known[1]), started(known[2])};
}

void MotionFilter::predict(const ModelStep& step) {
  mean_ = (step.phi * mean_).eval();
  predict_any(first_, step);
  for (ModelMatrix& other : others_) predict_any(other, step);
}

void MotionFilter::update(const Vec3& z, const Vec3& r) {
  const Vec3 known = r.cwiseMax(kLeastVariance);
  if (others_.empty() && (known[0] != known[1] || known[1] != known[2])) others_ = {first_, first_};
  for (int axis = 0; axis < 3; ++axis) {
    const ModelMatrix& p = covariance(axis);
    mean_.col(axis) += p.col(0) * ((z[axis] - mean_(0, axis)) / (p(0, 0) + known[axis]));
  }
  update_covariance(first_, known[0]);
  for (std::size_t i = 0; i < others_.size(); ++i) update_covariance(others_[i], known[static_cast<int>(i) + 1]);
}

Vec3 MotionFilter::variance() const { return Vec3(covariance(0)(0, 0), covariance(1)(0, 0), covariance(2)(0, 0)); }

AxisFilter MotionFilter::marginal(int axis) const {
  const ModelMatrix& p = covariance(axis);
  return {mean_(0, axis), mean_(1, axis), p(0, 0), p(0, 1), p(1, 1)};
}

Vec3 MotionFilter::position_at(const ModelLook& ahead) const { return mean_.transpose() * ahead.position; }

Vec3 MotionFilter::velocity_at(const ModelLook& ahead) const { return mean_.transpose() * ahead.velocity; }

Vec3 MotionFilter::variance_at(const ModelLook& ahead) const {
  const double first = variance_of(first_, ahead);
  if (others_.empty()) return Vec3::Constant(first);
  return Vec3(first, variance_of(others_[0], ahead), variance_of(others_[1], ahead));
}

}  // namespace tern
