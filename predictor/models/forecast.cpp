#include "predictor/models/forecast.h"

#include <algorithm>
#include <cmath>

namespace tern {
namespace {

// Simpson's nodes of crossing_integral: relative error below 1e-3 against adaptive quadrature (see its test).
constexpr int kSimpsonIntervals = 48;
double crossing_rate(double xx, double xv, double vv) { return std::sqrt(std::max(0.0, xx * vv - xv * xv)) / xx; }

double crossing_rate(const AxisFilter& start, double q, double t) {
  AxisFilter p = start;
  p.predict(t, q);
  return crossing_rate(p.xx, p.xv, p.vv);
}

struct SimpsonNode {
  double t, weight;  // s
};

// Simpson's rule on t = horizon·u³; at u = 0 dt/du = 0.
std::vector<SimpsonNode> simpson(double horizon_s) {
  std::vector<SimpsonNode> nodes;
  for (int i = 1; i <= kSimpsonIntervals; ++i) {
    const double u = static_cast<double>(i) / kSimpsonIntervals;
    const double weight = i == kSimpsonIntervals ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    nodes.push_back({horizon_s * u * u * u, weight * 3.0 * horizon_s * u * u / (3.0 * kSimpsonIntervals)});
  }
  return nodes;
}

}  // namespace

double crossing_integral(const AxisFilter& filter, double q, double horizon_s) {
  double sum = 0.0;
  for (const auto& [t, weight] : simpson(horizon_s)) sum += weight * crossing_rate(filter, q, t);
  return sum;
}

AxisForecast forecast(const AxisFilter& filter, double q, const PredictionSpec& spec) {
  AxisForecast result;
  for (const Duration end : piece_ends(spec)) {
    AxisFilter at = filter;
    at.predict(end.seconds(), q);
    result.mean.push_back(at.x);
    result.sigma.push_back(std::sqrt(at.xx));
  }
  result.crossings = crossing_integral(filter, q, spec.horizon.seconds());
  result.speed = std::abs(filter.v);
  return result;
}

StartSpread start_spread(double still_s, const AccelerationModel& model, const PredictionSpec& spec) {
  const auto added_at = [&](double t) -> StartSpread::Added {
    if (t <= still_s) return {};
    const Transition step = transition(model, t - still_s);
    const Eigen::Vector3d pushed = model.time_s > 0.0 ? Eigen::Vector3d(model.sigma * step.phi.col(2))
                                                      : Eigen::Vector3d(spec.speed_deviation() * step.phi.col(1));
    const Eigen::Matrix3d moved = step.q + pushed * pushed.transpose();
    return {moved(0, 0), moved(0, 1), moved(1, 1)};
  };
  StartSpread spread;
  for (const Duration end : piece_ends(spec)) spread.ends.push_back(added_at(end.seconds()));
  for (const auto& [t, weight] : simpson(spec.horizon.seconds())) spread.nodes.push_back(added_at(t));
  return spread;
}

AxisForecast forecast_of_rest(const AxisFilter& filter, double q, const StartSpread& start,
                              const PredictionSpec& spec) {
  const auto covariance_at = [&](double t, const StartSpread::Added& added) {
    AxisFilter at = filter;
    at.predict(t, q);
    at.xx += added.xx;
    at.xv += added.xv;
    at.vv += added.vv;
    return at;
  };
  AxisForecast result;
  const std::vector<Duration> ends = piece_ends(spec);
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const AxisFilter at = covariance_at(ends[k].seconds(), start.ends[k]);
    result.mean.push_back(at.x);
    result.sigma.push_back(std::sqrt(at.xx));
  }
  std::size_t k = 0;
  for (const auto& [t, weight] : simpson(spec.horizon.seconds())) {
    const AxisFilter at = covariance_at(t, start.nodes[k++]);
    result.crossings += weight * crossing_rate(at.xx, at.xv, at.vv);
  }
  result.speed = std::abs(filter.v);
  return result;
}

SingerForecaster::SingerForecaster(const AccelerationModel& model, const PredictionSpec& spec) {
  for (const Duration end : piece_ends(spec)) ends_.push_back(transition(model, end.seconds()));
  for (const auto& [t, weight] : simpson(spec.horizon.seconds())) nodes_.push_back({transition(model, t), weight});
}

AxisForecast SingerForecaster::forecast(const SingerFilter& filter) const {
  AxisForecast result;
  for (const Transition& step : ends_) {
    SingerFilter at = filter;
    at.predict(step);
    result.mean.push_back(at.state[0]);
    result.sigma.push_back(std::sqrt(at.covariance(0, 0)));
  }
  for (const Node& node : nodes_) {
    const Eigen::Matrix3d p = node.step.phi * filter.covariance * node.step.phi.transpose() + node.step.q;
    result.crossings += node.weight * crossing_rate(p(0, 0), p(0, 1), p(1, 1));
  }
  result.speed = std::abs(filter.state[1]);
  result.max_curvature = std::abs(filter.state[2]);
  return result;
}

}  // namespace tern
