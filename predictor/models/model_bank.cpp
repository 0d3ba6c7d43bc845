#include "predictor/models/model_bank.h"

#include <algorithm>
#include <limits>

#include "predictor/models/axis_filter.h"

namespace tern {
namespace {

constexpr double kEvidenceForgetting = 0.95;

Fit fit_of(const MotionFilter& filter, const Vec3& z, const Vec3& r) {
  return fit(filter.position(), filter.variance(), z, r);
}

// Whether one axis alone is beyond the gate: most pairs of a track and a detection are, and cost no more than that.
bool is_beyond(const MotionFilter& filter, double gate, const Vec3& z, const Vec3& r) {
  for (int axis = 0; axis < 3; ++axis) {
    const AxisFilter of = filter.marginal(axis);
    if (std::pow(z[axis] - of.x, 2) > gate * (of.xx + std::max(r[axis], kLeastVariance))) return true;
  }
  return false;
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

BankLook bank_look(const BankStep& ahead, const BankStep& first) {
  BankLook looks;
  for (std::size_t j = 0; j < kModels; ++j) looks[j] = look(ahead[j], first[j]);
  return looks;
}

BankFilter::BankFilter(const Vec3& z, const Vec3& r) {
  for (std::size_t j = 0; j < kModels; ++j) filters_[j] = MotionFilter(motion_models()[j], z, r);
  lead_ = kWidestModel;
}

void BankFilter::predict(const BankStep& step) {
  for (std::size_t j = 0; j < kModels; ++j) filters_[j].predict(step[j]);
}

void BankFilter::update(const Vec3& z, const Vec3& r) {
  for (std::size_t j = 0; j < kModels; ++j) {
    evidence_[j] = kEvidenceForgetting * evidence_[j] - 0.5 * fit_of(filters_[j], z, r).surprise();
    filters_[j].update(z, r);
  }
  lead_ = static_cast<std::size_t>(std::max_element(evidence_.begin(), evidence_.end()) - evidence_.begin());
}

double BankFilter::distance2(const Vec3& z, const Vec3& r) const {
  return std::min(fit_of(lead(), z, r).distance2, fit_of(filters_[kWidestModel], z, r).distance2);
}

double BankFilter::surprise_within(double gate, const Vec3& z, const Vec3& r) const {
  double least = std::numeric_limits<double>::infinity();
  for (const MotionFilter* filter : {&lead(), &filters_[kWidestModel]}) {
    if (is_beyond(*filter, gate, z, r)) continue;
    const Fit of = fit_of(*filter, z, r);
    if (of.distance2 <= gate) least = std::min(least, of.surprise());
  }
  return least;
}

}  // namespace tern
