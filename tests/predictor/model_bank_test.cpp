#include "predictor/models/model_bank.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace tern {
namespace {

// Oracle: one axis of one model, by the textbook's equations on matrices of any size.
struct PlainFilter {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;

  PlainFilter(const MotionModel& model, double z, double r)
      : mean(model.shift * z), covariance(model.prior + r * model.shift * model.shift.transpose()) {}
  void predict(const ModelStep& step) {
    mean = (Eigen::MatrixXd(step.phi) * mean).eval();
    covariance = (step.phi * covariance * step.phi.transpose() + step.q).eval();
  }
  void update(double z, double r) {
    const Eigen::VectorXd gain = covariance.col(0) / (covariance(0, 0) + r);
    mean += gain * (z - mean[0]);
    covariance -= (gain * covariance.row(0)).eval();
  }
};

void expect_near(double value, double wanted, double scale) { EXPECT_NEAR(value, wanted, 1e-8 * scale); }

void expect_equal(const BankFilter& bank, std::size_t model, const std::array<PlainFilter, 3>& plain,
                  const ModelStep& step) {
  const FilterPrediction ahead = bank.of(model).at(output_rows(step));
  for (int axis = 0; axis < 3; ++axis) {
    PlainFilter there = plain[static_cast<std::size_t>(axis)];
    const AxisFilter now = bank.of(model).marginal(axis);
    expect_near(now.x, there.mean[0], 10.0);
    expect_near(now.v, there.mean[1], 10.0);
    expect_near(now.xx, there.covariance(0, 0), 1.0);
    expect_near(now.xv, there.covariance(0, 1), 1.0);
    expect_near(now.vv, there.covariance(1, 1), 10.0);
    there.predict(step);
    expect_near(ahead.position[axis], there.mean[0], 10.0);
    expect_near(ahead.velocity[axis], there.mean[1], 10.0);
    expect_near(ahead.variance[axis], there.covariance(0, 0), 10.0);
  }
}

TEST(BankFilter, IsTheTextbooksFilterOfEachModelAlsoWhereAxesAreMeasuredUnequally) {
  Rng rng(1);
  for (int round = 0; round < 20; ++round) {
    const auto variances = [&](int n) -> Vec3 {
      const bool alike = n < round;
      const double r = rng.uniform(1e-4, 1e-2);
      return alike ? Vec3::Constant(r) : Vec3(r, rng.uniform(1e-4, 1e-2), rng.uniform(1e-4, 1e-2));
    };
    Vec3 z(rng.normal(), rng.normal(), rng.normal()), r = variances(0);
    BankFilter bank(z, r);
    std::vector<std::array<PlainFilter, 3>> plain;
    for (const MotionModel& model : motion_models()) {
      plain.push_back({PlainFilter(model, z[0], r[0]), PlainFilter(model, z[1], r[1]), PlainFilter(model, z[2], r[2])});
    }
    for (int n = 1; n < 25; ++n) {
      const BankStep step = bank_step(rng.uniform(0.0, 0.2)), ahead = bank_step(rng.uniform(0.0, 2.0));
      z += 0.1 * Vec3(rng.normal(), rng.normal(), rng.normal());
      r = variances(n);
      bank.predict(step);
      bank.update(z, r);
      for (std::size_t j = 0; j < kModels; ++j) {
        for (int axis = 0; axis < 3; ++axis) {
          plain[j][static_cast<std::size_t>(axis)].predict(step[j]);
          plain[j][static_cast<std::size_t>(axis)].update(z[axis], r[axis]);
        }
        expect_equal(bank, j, plain[j], ahead[j]);
      }
      if (HasFailure()) FAIL() << "round " << round << ", measurement " << n;
    }
  }
}

TEST(BankFilter, OrdersAreThoseOfTheModels) {
  for (std::size_t j = 0; j < kModels; ++j) EXPECT_EQ(kOrders[j], motion_models()[j].order()) << j;
}

TEST(BankFilter, ItsGateBoxContainsEveryDetectionWithinTheGate) {
  Rng rng(7);
  BankFilter bank(Vec3::Zero(), Vec3::Constant(0.01));
  int within = 0;
  for (int k = 1; k <= 60; ++k) {
    bank.predict(bank_step(1.0 / 30.0));
    const Vec3 most = Vec3::Constant(rng.uniform(0.001, 0.5));
    const Box box = bank.gate_box(21.1, most);
    for (int n = 0; n < 200; ++n) {
      const Vec3 z = bank.lead().position() + 3.0 * Vec3(rng.normal(), rng.normal(), rng.normal());
      const Vec3 r = rng.uniform() * most;
      if (!std::isfinite(bank.cost_within(21.1, z, r))) continue;
      ++within;
      EXPECT_TRUE(box.contains(z));
    }
    bank.update(Vec3(2.0 * k / 30.0, 0.1 * rng.normal(), 0.1 * rng.normal()), Vec3::Constant(0.01));
  }
  EXPECT_GT(within, 100);
}

}  // namespace
}  // namespace tern
