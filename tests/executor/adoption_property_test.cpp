// Adopted plans against dense sampling: illegal trajectories are refused, legal ones are adopted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "executor/executor.h"

namespace tern {
namespace {

constexpr UTime kZero{1'700'000'000'000'000};
constexpr int kSamples = 4'000;

/// A vehicle whose limits and flight box are kept by about half of the random plans.
UavSpec tight_vehicle(Rng& rng) {
  UavSpec uav;
  uav.start = Vec3(0.0, 0.0, 2.0);
  const double scale = rng.uniform(0.3, 3.0);
  uav.limits.v_max = Vec3(4.0, 4.0, 3.0) * scale;
  uav.limits.a_max = Vec3(25.0, 25.0, 20.0) * scale;
  uav.limits.j_max = Vec3::Constant(500.0 * scale);
  uav.flight_box = box_around(uav.start, Vec3(2.5, 2.5, 1.8) * rng.uniform(0.5, 2.0));
  uav.body.vertices.resize(3, 2);
  uav.body.vertices << -0.1, 0.2, -0.1, 0.1, -0.3, 0.1;
  uav.body.radius = 0.05;
  return uav;
}

Plan random_plan(Rng& rng, const HorizonRequest& request) {
  Plan plan;
  plan.request_id = request.id;
  plan.outcome = PlanOutcome::SearchOnly;
  const auto intervals = 6 + static_cast<int>(rng.uniform() * 5.0);
  const Duration interval{200'000 + static_cast<std::int64_t>(rng.uniform() * 200'000.0)};
  Points q(3, intervals + 3);
  q.leftCols<3>() = start_control_points(request.start, interval.seconds());
  for (Eigen::Index k = 3; k < q.cols(); ++k) {
    const bool end = k > q.cols() - 3;
    const Vec3 step(rng.uniform(-0.5, 0.7), rng.uniform(-0.5, 0.5), rng.uniform(-0.3, 0.3));
    q.col(k) = q.col(k - 1) + (end ? Vec3::Zero() : step);
  }
  plan.trajectory = {request.t_s, interval, q};
  return plan;
}

/// Largest excess of the sampled motion over its limits, as a share of the limit (box: m); ≤ 0: all rules are kept.
double worst_excess(const TimedSpline& trajectory, const UavSpec& uav) {
  const ClampedSpline spline = trajectory.spline();
  double worst = -1e9;
  for (int k = 0; k <= kSamples; ++k) {
    const MotionSample m = spline.sample(spline.duration_s() * k / kSamples);
    worst = std::max(worst, (m.v.cwiseAbs().cwiseQuotient(uav.limits.v_max)).maxCoeff() - 1.0);
    worst = std::max(worst, (m.a.cwiseAbs().cwiseQuotient(uav.limits.a_max)).maxCoeff() - 1.0);
    worst = std::max(worst, (m.j.cwiseAbs().cwiseQuotient(uav.limits.j_max)).maxCoeff() - 1.0);
    for (Eigen::Index c = 0; c < uav.body.vertices.cols(); ++c) {
      const Vec3 p = m.p + uav.body.vertices.col(c);
      const Vec3 reach = Vec3::Constant(uav.body.radius);
      worst = std::max(worst, (p + reach - uav.flight_box.max()).maxCoeff());
      worst = std::max(worst, (uav.flight_box.min() + reach - p).maxCoeff());
    }
  }
  return worst;
}

TEST(Adoption, AdoptsExactlyWhatDenseSamplingAllows) {
  Rng rng(11);
  int adopted = 0;
  int refused = 0;
  for (int round = 0; round < 400; ++round) {
    const UavSpec uav = tight_vehicle(rng);
    Executor executor(uav, kZero);
    executor.begin(kZero);
    executor.set_mode(GoalMode::Go);
    // Two plans, so that the second one starts in motion if the first was adopted.
    for (int k = 0; k < 2; ++k) {
      const UTime now = kZero + Duration{400'000} * k;
      const auto request = executor.next_request(now);
      ASSERT_TRUE(request);
      const Plan plan = random_plan(rng, *request);
      const double excess = worst_excess(plan.trajectory, uav);
      const Adoption adoption = executor.consider(plan, now + Duration{1'000});
      // An extremum between samples may exceed a little; apart from that both must agree.
      if (std::abs(excess) < 1e-4) continue;
      EXPECT_EQ(adoption.verdict == Verdict::Adopted, excess < 0.0)
          << "round " << round << ": " << to_string(adoption) << " " << adoption.detail << ", sampled " << excess;
      (adoption.verdict == Verdict::Adopted ? adopted : refused) += 1;
    }
  }
  EXPECT_GT(adopted, 100);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace tern
