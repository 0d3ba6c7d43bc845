#include "predictor/models/motion_filter.h"

#include <algorithm>
#include <type_traits>

namespace tern {
namespace {

template <int N>
using Square = Eigen::Matrix<double, N, N>;
template <int N>
using Column = Eigen::Matrix<double, N, 1>;
template <int N>
using Means = Eigen::Matrix<double, N, 3>;

// Models of this order or more are processes around a constant (motion_model.h): the last rows of F and D are zero.
constexpr int kMinOrderAroundConstant = 4;

// Calls f<N>() for the order N. With sizes known at compile time the products are several times faster.
template <typename F>
auto with_order(int order, const F& f) {
  switch (order) {
    case 2: return f(std::integral_constant<int, 2>{});
    case 3: return f(std::integral_constant<int, 3>{});
    case 4: return f(std::integral_constant<int, 4>{});
    default: return f(std::integral_constant<int, kMaxOrder>{});
  }
}

// Calls f once if the axes share a covariance, else for each axis.
template <typename Number, typename F>
void for_each_covariance(const FilterStates<Number>& states, const F& f) {
  f(0);
  for (int axis = 1; axis < 3; ++axis) {
    if (states.covariance[idx(axis)] != states.covariance[0]) f(axis);
  }
}

template <int N>
Eigen::Map<const Square<N>> square(const double* entries) {
  return Eigen::Map<const Square<N>>(entries);
}

template <int N>
Eigen::Map<Square<N>> square(double* entries) {
  return Eigen::Map<Square<N>>(entries);
}

// Copies the lower half to the upper one.
template <int N>
void mirror(Eigen::Map<Square<N>>& p) {
  for (int j = 1; j < N; ++j) {
    for (int i = 0; i < j; ++i) p(i, j) = p(j, i);
  }
}

// The columns from kColumn on of P = moved Φᵀ + Q, without the last row, from the pair of rows of the diagonal on.
template <int N, int kColumn>
void predict_columns(const Eigen::Map<const Square<N>>& phi, const Eigen::Map<const Square<N>>& q,
                     const Eigen::Matrix<double, N - 1, N>& moved, Eigen::Map<Square<N>>& p) {
  if constexpr (kColumn < N - 1) {
    constexpr int kFirst = kColumn - kColumn % 2, kRows = N - 1 - kFirst;
    Eigen::Matrix<double, kRows, 1> sum = q.col(kColumn).template segment<kRows>(kFirst);
    for (int k = 0; k < N; ++k) sum += moved.col(k).template segment<kRows>(kFirst) * phi(kColumn, k);
    p.col(kColumn).template segment<kRows>(kFirst) = sum;
    predict_columns<N, kColumn + 1>(phi, q, moved, p);
  }
}

// P ← Φ P Φᵀ + Q, column by column, which compilers vectorise best; then the lower half is mirrored.
template <int N>
void predict_covariance(const Eigen::Map<const Square<N>>& phi, const Eigen::Map<const Square<N>>& q,
                        double* covariance) {
  auto p = square<N>(covariance);
  Square<N> moved;
  for (int j = 0; j < N; ++j) {
    Column<N> sum = phi.col(0) * p(0, j);
    for (int k = 1; k < N; ++k) sum += phi.col(k) * p(k, j);
    moved.col(j) = sum;
  }
  for (int j = 0; j < N; ++j) {
    Column<N> sum = q.col(j);
    for (int k = 0; k < N; ++k) sum += moved.col(k) * phi(j, k);
    p.col(j) = sum;
  }
  mirror<N>(p);
}

// The same for models around a constant, their last state. The last row of Φ is that of the identity, so it needs no
// products. Of the other rows, pairs above the diagonal are left out.
template <int N>
void predict_around_constant(const Eigen::Map<const Square<N>>& phi, const Eigen::Map<const Square<N>>& q,
                             double* covariance) {
  constexpr int kMoving = N - 1;
  using Rows = Eigen::Matrix<double, kMoving, 1>;
  auto p = square<N>(covariance);
  Eigen::Matrix<double, kMoving, N> moved;
  for (int j = 0; j < N; ++j) {
    Rows sum = phi.col(0).template head<kMoving>() * p(0, j);
    for (int k = 1; k < N; ++k) sum += phi.col(k).template head<kMoving>() * p(k, j);
    moved.col(j) = sum;
  }
  Rows last = q.row(kMoving).template head<kMoving>().transpose();
  for (int k = 0; k < N; ++k) last += phi.col(k).template head<kMoving>() * p(kMoving, k);
  p(kMoving, kMoving) += q(kMoving, kMoving);
  p.row(kMoving).template head<kMoving>() = last.transpose();
  predict_columns<N, 0>(phi, q, moved, p);
  mirror<N>(p);
}

}  // namespace

OutputRows output_rows(const ModelStep& step) {
  return {step.phi.row(0).transpose(), step.phi.row(1).transpose(), step.q(0, 0)};
}

OutputRows output_rows(const ModelStep& ahead, const ModelStep& first) {
  const ModelVector row = ahead.phi.row(0).transpose();
  return {first.phi.transpose() * row, first.phi.transpose() * ahead.phi.row(1).transpose(),
          ahead.q(0, 0) + row.dot(first.q * row)};
}

void start(const MotionModel& model, const Vec3& z, const Vec3& r, const FilterStates<double>& states) {
  const int n = states.order;
  const Vec3 known = r.cwiseMax(kMinVariance);
  Eigen::Map<Eigen::MatrixXd>(states.mean, n, 3) = model.shift * z.transpose();
  for_each_covariance(states, [&](int axis) {
    Eigen::Map<Eigen::MatrixXd>(states.covariance[idx(axis)], n, n) =
        model.prior + known[axis] * model.shift * model.shift.transpose();
  });
}

void predict(const ModelStep& step, const FilterStates<double>& states) {
  with_order(states.order, [&](auto order) {
    constexpr int kOrder = decltype(order)::value;
    const auto phi = square<kOrder>(step.phi.data()), q = square<kOrder>(step.q.data());
    Eigen::Map<Means<kOrder>> mean(states.mean);
    mean = (phi * mean).eval();
    for_each_covariance(states, [&](int axis) {
      double* covariance = states.covariance[idx(axis)];
      if constexpr (kOrder < kMinOrderAroundConstant) {
        predict_covariance<kOrder>(phi, q, covariance);
      } else {
        predict_around_constant<kOrder>(phi, q, covariance);
      }
    });
  });
}

void update(const Vec3& z, const Vec3& r, const FilterStates<double>& states) {
  const Vec3 known = r.cwiseMax(kMinVariance);
  with_order(states.order, [&](auto order) {
    constexpr int kOrder = decltype(order)::value;
    Eigen::Map<Means<kOrder>> mean(states.mean);
    for (int axis = 0; axis < 3; ++axis) {
      const auto p = square<kOrder>(states.covariance[idx(axis)]);
      mean.col(axis) += p.col(0) * ((z[axis] - mean(0, axis)) / (p(0, 0) + known[axis]));
    }
    for_each_covariance(states, [&](int axis) {
      auto p = square<kOrder>(states.covariance[idx(axis)]);
      const Column<kOrder> column = p.col(0);
      const Column<kOrder> gain = column / (column[0] + known[axis]);
      p.noalias() -= column * gain.transpose();
    });
  });
}

Vec3 MotionFilter::variance() const {
  return Vec3(*states_.covariance[0], *states_.covariance[1], *states_.covariance[2]);
}

AxisFilter MotionFilter::marginal(int axis) const {
  const int n = states_.order;
  const double* mean = states_.mean + static_cast<std::ptrdiff_t>(n) * axis;
  const double* p = states_.covariance[idx(axis)];
  return {mean[0], mean[1], p[0], p[1], p[n + 1]};
}

FilterPrediction MotionFilter::at(const OutputRows& ahead) const {
  return with_order(states_.order, [&](auto order) {
    constexpr int kOrder = decltype(order)::value;
    const Eigen::Map<const Column<kOrder>> position(ahead.position.data()), velocity(ahead.velocity.data());
    const Eigen::Map<const Means<kOrder>> mean(states_.mean);
    FilterPrediction predicted{mean.transpose() * position, mean.transpose() * velocity, Vec3::Zero()};
    double variance = 0.0;
    for_each_covariance(states_, [&](int axis) {
      const Column<kOrder> moved = square<kOrder>(states_.covariance[idx(axis)]) * position;
      variance = std::max(0.0, ahead.variance + moved.dot(position));
      predicted.variance.tail(3 - axis).setConstant(variance);
    });
    return predicted;
  });
}

}  // namespace tern
