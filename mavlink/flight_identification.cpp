#include "mavlink/flight_identification.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace tern::mavlink {
namespace {

/// The filters have forgotten their start after this time, s.
constexpr double kSettle = 1.5;
/// A longer gap between two estimates begins anew, s.
constexpr double kGap = 0.1;
/// PX4 filters the derivative of the velocity with this time constant (MPC_VELD_LP, 5 Hz), s.
constexpr double kRateFilter = 0.032;
constexpr double kMoving = 1.0;  // m/s
/// A vehicle that accelerates by much more or less than commanded is another one than this model.
constexpr double kMaxOff = 0.15;
/// Residuals of neighbouring spans depend on each other: the standard error is larger than that of independent ones.
constexpr double kDependent = 2.0;

/// Share by which a first-order lag nears its input within dt.
double nearing(double dt, double lag) { return 1.0 - std::exp(-dt / lag); }

}  // namespace

void FlightIdentification::sent(const Vec3& p, const Vec3& v, const Vec3& a) {
  sent_ = Sent{p.head<2>(), v.head<2>(), a.head<2>()};
}

void FlightIdentification::begin(UTime at, const Eigen::Vector2d& v) {
  last_ = at;
  settled_s_ = 0.0;
  v_ = v;
  rate_.setZero();
  for (Fit& fit : fits_) fit.lagged = sent_->a;
}

void FlightIdentification::add(UTime at, const Vec3& p_W, const Vec3& v_W, const LoopGains& gains) {
  if (!sent_ || (last_ && at <= *last_)) return;
  const Eigen::Vector2d p = p_W.head<2>(), v = v_W.head<2>();
  const double dt = last_ ? (at - *last_).seconds() : kGap;
  if (!last_ || dt >= kGap) return begin(at, v);
  last_ = at;
  rate_ += nearing(dt, kRateFilter) * ((v - v_) / dt - rate_);
  v_ = v;
  const Eigen::Vector2d error = sent_->v + gains.position_p * (sent_->p - p) - v;
  integral_ += gains.velocity_i * dt * error;
  const Eigen::Vector2d commanded = sent_->a + gains.velocity_p * error + integral_ - gains.velocity_d * rate_;
  for (std::size_t k = 0; k < kLags; ++k) fits_[k].lagged += nearing(dt, lag_of(k)) * (commanded - fits_[k].lagged);
  settled_s_ += dt;
  if (settled_s_ < kSettle) {
    span_v_ = v;
    travelled_.setZero();
    for (Fit& fit : fits_) fit.sum.setZero();
    span_s_ = 0.0;
    return;
  }
  if (v.norm() > kMoving) moved_s_ += dt;
  for (Fit& fit : fits_) fit.sum += dt * fit.lagged;
  travelled_ += dt * v;
  span_s_ += dt;
  if (span_s_ >= kSpan.seconds()) close_span(v);
}

void FlightIdentification::close_span(const Eigen::Vector2d& v) {
  const Eigen::Vector2d change = v - span_v_;
  for (Fit& fit : fits_) {
    for (int axis = 0; axis < 2; ++axis) {
      Row row(fit.sum[axis], -travelled_[axis], 0.0, 0.0);
      row[2 + axis] = span_s_;
      fit.normal += row * row.transpose();
      fit.right += row * change[axis];
    }
    fit.sum.setZero();
  }
  squares_ += change.squaredNorm();
  spans_ += 2;
  span_v_ = v;
  travelled_.setZero();
  span_s_ = 0.0;
}

std::optional<FlightIdentification::Answer> FlightIdentification::answer() const {
  if (moved_s_ < kLeastMotion) return std::nullopt;
  double least = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  Answer answer;
  for (std::size_t k = 0; k < kLags; ++k) {
    const Eigen::LDLT<Eigen::Matrix<double, kUnknowns, kUnknowns>> solver(fits_[k].normal);
    const Row unknowns = solver.solve(fits_[k].right);
    const double residual = squares_ - unknowns.dot(fits_[k].right);
    if (!(residual < least)) continue;
    least = residual;
    best = k;
    const double variance = std::max(residual, 0.0) / std::max(spans_ - kUnknowns, 1);
    const double sigma = std::sqrt(variance * solver.solve(Row::Unit(1))[1]);
    answer = {unknowns[1], kDependent * sigma, lag_of(k), unknowns[0], moved_s_};
  }
  const bool inside = best > 0 && best + 1 < kLags, fits = std::abs(answer.share - 1.0) <= kMaxOff;
  if (!inside || !fits || !(answer.drag_sigma <= kMaxSigma)) return std::nullopt;
  return answer;
}

}  // namespace tern::mavlink
