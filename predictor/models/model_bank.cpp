#include "predictor/models/model_bank.h"

#include <algorithm>
#include <limits>

#include "predictor/models/axis_filter.h"

namespace tern {
namespace {

constexpr double kEvidenceForgetting = 0.95;

// Where a model's states begin in the bank's memory.
struct Begin {
  int mean = 0, covariance = 0;
};
constexpr PerModel<Begin> kBegins = [] {
  PerModel<Begin> begins{};
  for (std::size_t j = 1; j < kModels; ++j) {
    const int order = kOrders[j - 1];
    begins[j] = {begins[j - 1].mean + 3 * order, begins[j - 1].covariance + order * order};
  }
  return begins;
}();

Fit fit_of(const MotionFilter& filter, const Vec3& z, const Vec3& r) {
  return fit(filter.position(), filter.variance(), z, r);
}

}  // namespace

const PerModel<MotionModel>& motion_models() {
  static const PerModel<MotionModel> models{constant_velocity(0.15, 1.2),
                                            constant_velocity(0.4, 1.5),  // steady
                                            singer(1.0, 1.0, 2.0),
                                            matern52(4.0, 1.0),  // calm
                                            squared_exponential(1.4, 1.0),
                                            squared_exponential(2.0, 0.8),
                                            squared_exponential(3.5, 0.6),
                                            constant_velocity(1.5, 4.0),
                                            singer(1.0, 4.0, 4.0),  // lively
                                            matern52(4.0, 4.0),
                                            matern52(8.0, 4.0),
                                            squared_exponential(0.7, 2.5),
                                            squared_exponential(1.0, 2.5),
                                            squared_exponential(1.4, 4.0),
                                            squared_exponential(2.0, 3.0)};
  return models;
}

BankStep bank_step(double dt) {
  BankStep steps;
  for (std::size_t j = 0; j < kModels; ++j) steps[j] = model_step(motion_models()[j], dt);
  return steps;
}

BankOutputRows bank_output_rows(const BankStep& ahead, const BankStep& first) {
  BankOutputRows rows;
  for (std::size_t j = 0; j < kModels; ++j) rows[j] = output_rows(ahead[j], first[j]);
  return rows;
}

template <typename Number, typename Bank>
FilterStates<Number> BankFilter::states(Bank& bank, std::size_t model) {
  const auto [mean, covariance] = kBegins[model];
  FilterStates<Number> of{kOrders[model], bank.means_.data() + mean, {}};
  of.covariance.fill(bank.covariances_.data() + covariance);
  if (bank.others_.empty()) return of;
  of.covariance[1] = bank.others_.data() + covariance;
  of.covariance[2] = bank.others_.data() + kCovariances + covariance;
  return of;
}

MotionFilter BankFilter::of(std::size_t model) const { return MotionFilter(states<const double>(*this, model)); }

BankFilter::BankFilter(const Vec3& z, const Vec3& r) : lead_(kWidestModel) {
  separate_axes(r);
  for (std::size_t j = 0; j < kModels; ++j) start(motion_models()[j], z, r, states<double>(*this, j));
}

void BankFilter::separate_axes(const Vec3& r) {
  const Vec3 known = r.cwiseMax(kMinVariance);
  if (known[0] == known[1] && known[1] == known[2]) return;
  separate_axes();
}

void BankFilter::separate_axes() {
  if (!others_.empty()) return;
  others_.assign(covariances_.begin(), covariances_.end());
  others_.insert(others_.end(), covariances_.begin(), covariances_.end());
}

void BankFilter::predict(const BankStep& step) {
  for (std::size_t j = 0; j < kModels; ++j) tern::predict(step[j], states<double>(*this, j));
}

void BankFilter::update(const Vec3& z, const Vec3& r) {
  separate_axes(r);
  for (std::size_t j = 0; j < kModels; ++j) {
    evidence_[j] = kEvidenceForgetting * evidence_[j] - 0.5 * fit_of(of(j), z, r).neg_log_likelihood();
    tern::update(z, r, states<double>(*this, j));
  }
  lead_ = idx(std::max_element(evidence_.begin(), evidence_.end()) - evidence_.begin());
}

void BankFilter::restart_axis(int axis, double z, double r) {
  separate_axes();
  const BankFilter anew(Vec3::Constant(z), Vec3::Constant(r));
  for (std::size_t j = 0; j < kModels; ++j) {
    const FilterStates<double> to = states<double>(*this, j);
    const FilterStates<const double> from = states<const double>(anew, j);
    std::copy_n(from.mean + static_cast<std::ptrdiff_t>(from.order) * axis, to.order,
                to.mean + static_cast<std::ptrdiff_t>(to.order) * axis);
    std::copy_n(from.covariance[0], to.order * to.order, to.covariance[idx(axis)]);
  }
}

double BankFilter::distance2(const Vec3& z, const Vec3& r) const {
  return std::min(fit_of(lead(), z, r).distance2, fit_of(of(kWidestModel), z, r).distance2);
}

double BankFilter::cost_within(double gate, const Vec3& z, const Vec3& r) const {
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t model : {lead_, kWidestModel}) {
    if (is_beyond(model, gate, z, r)) continue;
    const Fit fit = fit_of(of(model), z, r);
    if (fit.distance2 <= gate) least = std::min(least, fit.neg_log_likelihood());
  }
  return least;
}

Box BankFilter::gate_box(double gate, const Vec3& r) const {
  Box within;
  for (const std::size_t model : {lead_, kWidestModel}) {
    const MotionFilter filter = of(model);
    within.extend(tern::gate_box(filter.position(), filter.variance(), gate, r));
  }
  return within;
}

bool BankFilter::is_beyond(std::size_t model, double gate, const Vec3& z, const Vec3& r) const {
  const auto [mean, covariance] = kBegins[model];
  const double* x = means_.data() + mean;
  const double* variance = covariances_.data() + covariance;
  for (int axis = 0; axis < 3; ++axis, x += kOrders[model]) {
    if (std::pow(z[axis] - *x, 2) > gate * (*variance + std::max(r[axis], kMinVariance))) return true;
    if (others_.empty()) continue;
    variance = axis == 0 ? others_.data() + covariance : variance + kCovariances;
  }
  return false;
}

}  // namespace tern
