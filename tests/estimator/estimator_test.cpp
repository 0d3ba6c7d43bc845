// Whole flights: consistency, darkness, fixes, an odometry frame without steps, wrong inputs, the same bits.
#include "estimator/estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "estimator/filter/feature.h"
#include "estimator/filter/position_fix.h"
#include "tests/support/effort.h"
#include "tests/support/vio_flight.h"

namespace tern {
namespace {

using support::error_of_estimate;
using support::VioEvent;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Flight {
  support::VioPath path = support::weaving();
  support::VioWorld world;
  support::VioSettings settings;
  EstimatorConfig config;

  [[nodiscard]] std::vector<VioEvent> events(std::uint64_t seed) const {
    return simulate(path, landmarks_of(world, seed), settings, seed);
  }
  [[nodiscard]] Estimator estimator() const { return Estimator(config, {PointInW{path.start}, path.yaw(0.0)}); }
};

InputOutcome give(Estimator& estimator, const VioEvent& event) {
  return event.is_frame ? estimator.add(event.frame) : estimator.add(event.sample);
}

std::int64_t count(const Estimator& estimator, Trouble trouble) { return estimator.status().count[idx(trouble)]; }

/// The filter's error over many flights, beside its own covariance.
struct Record {
  int flights = 0;
  double end_nees = 0.0;  ///< sum of the poses' NEES at the end
  double end_error2 = 0.0, end_variance = 0.0, peak_sigma = 0.0, peak_error = 0.0;
  std::int64_t instants = 0, covered = 0;

  void add(const Flight& flight, std::uint64_t seed) {
    Estimator estimator = flight.estimator();
    support::VioError last;
    for (const VioEvent& event : flight.events(seed)) {
      give(estimator, event);
      if (!event.is_frame || event.t <= 0.0) continue;
      last = error_of_estimate(estimator.estimate().value(), event.truth);
      ++instants;
      covered += last.position_nees < 11.345 ? 1 : 0;
      peak_sigma = std::max(peak_sigma, last.sigma);
      peak_error = std::max(peak_error, last.position);
    }
    ++flights;
    end_nees += last.nees;
    end_error2 += last.position * last.position;
    end_variance += last.sigma * last.sigma;
  }
  [[nodiscard]] double coverage() const { return static_cast<double>(covered) / static_cast<double>(instants); }
};

/// The sum of NEES is χ² with 6 degrees of freedom per flight: its bounds at 99.9 %.
void expect_consistent(const Record& record) {
  EXPECT_LT(record.end_nees, chi_square_quantile(6 * record.flights, 3.29));
  EXPECT_GT(record.end_nees, chi_square_quantile(6 * record.flights, -3.29));
  EXPECT_GT(record.coverage(), 0.96);
}

TEST(EstimatorFlights, ErrorsAreWhatTheCovarianceSays) {
  const Flight flight;
  Record record;
  for (int seed = 1; seed <= std::max(8, support::at_effort(100)); ++seed) {
    record.add(flight, static_cast<std::uint64_t>(seed));
  }
  expect_consistent(record);
  // 80 m of way with texture all around.
  EXPECT_LT(std::sqrt(record.end_error2 / record.flights), 0.4);
}

TEST(EstimatorDarkFlights, ErrorsAreWhatTheCovarianceSays) {
  Flight flight;
  flight.settings.dark = {{6.0, 11.0}};
  Record record;
  for (int seed = 101; seed <= 100 + std::max(6, support::at_effort(60)); ++seed) {
    record.add(flight, static_cast<std::uint64_t>(seed));
  }
  expect_consistent(record);
  EXPECT_GT(record.peak_sigma, 0.3);  // it knows that it is blind
}

TEST(EstimatorDarkFlights, DeadReckoningGrowsAsTheClosedForm) {
  EstimatorConfig config;
  StartState start;
  start.at = UTime{1'000'000};
  start.velocity.xyz = Vec3(4.0, 0.0, 0.0);
  Estimator estimator(config);
  estimator.start(start);
  const double h = 0.005, g = config.gravity;
  for (int k = 1; k <= 1000; ++k) {
    const UTime at = start.at + Duration{5000} * k;
    ASSERT_EQ(estimator.add(ImuSample{at, Vec3::Zero(), Vec3(0.0, 0.0, g)}), InputOutcome::Used);
    if (k % 200 != 0) continue;
    const Estimate estimate = estimator.estimate().value();
    const double t = k * h;
    EXPECT_LT((estimate.pose.p - Vec3(4.0 * t, 0.0, 0.0)).norm(), 1e-9);
    const double a2 = std::pow(g * start.attitude_deviation, 2) + std::pow(start.accel_bias_deviation, 2);
    const ImuNoise& n = config.noise;
    const double sway2 = std::pow(start.position_deviation, 2) + std::pow(start.velocity_deviation * t, 2) +
                         0.25 * a2 * std::pow(t, 4) + n.accel * n.accel * std::pow(t, 3) / 3.0 +
                         (g * g * n.gyro * n.gyro + n.accel_walk * n.accel_walk) * std::pow(t, 5) / 20.0 +
                         std::pow(g * start.gyro_bias_deviation, 2) * std::pow(t, 6) / 36.0;
    EXPECT_NEAR(estimate.covariance(kPositionError, kPositionError), sway2, 0.01 * sway2) << t;
  }
  EXPECT_EQ(estimator.estimate()->state, EstimatorState::Blind);
}

TEST(EstimatorFlights, OdometryHasNoSteps) {
  Flight flight;
  flight.settings.dark = {{5.0, 10.0}};
  Estimator estimator = flight.estimator();
  std::optional<Estimate> before;
  double step = 0.0, world_step = 0.0;
  for (const VioEvent& event : flight.events(3)) {
    give(estimator, event);
    const auto now = estimator.estimate();
    if (now && before) {
      // A sample moves the pose by its velocity; a frame must not move it.
      const double dt = (now->at - before->at).seconds();
      const Vec3 mean = 0.5 * (now->velocity.xyz + before->velocity.xyz);
      const double slack = 0.5 * dt * (now->velocity.xyz - before->velocity.xyz).norm();
      step = std::max(step, (now->pose.p - before->pose.p - dt * mean).norm() - slack);
      world_step = std::max(world_step, (now->pose_in_W().p - before->pose_in_W().p).norm());
    }
    before = now;
  }
  EXPECT_LT(step, flight.config.max_step + 1e-6);
  EXPECT_GT(world_step, 0.1);  // texture came back: the correction went into T_WO
  EXPECT_GT(before->T_WO.epoch, 0);
}

TEST(EstimatorFlights, AFixCorrectsT_WOAndItsWrongOneIsRefused) {
  const Flight flight;
  Estimator without = flight.estimator(), with = flight.estimator();
  NavState truth;
  for (const VioEvent& event : flight.events(4)) {
    give(without, event);
    give(with, event);
    truth = event.truth;
    if (!event.is_frame || std::abs(event.t - 12.0) > 0.01) continue;
    PositionFix fix;
    fix.at = event.sample.at;
    fix.position = event.truth.p + Vec3(3.0, 0.0, 0.0);
    fix.variance = Vec3::Constant(0.0025);
    EXPECT_EQ(with.add(fix), InputOutcome::Used);
    EXPECT_EQ(count(with, Trouble::FixContradicts), 1);
    fix.position = event.truth.p;
    const Vec3 in_O = with.estimate()->pose.p;
    EXPECT_EQ(with.add(fix), InputOutcome::Used);
    EXPECT_LT((with.estimate()->pose.p - in_O).norm(), flight.config.max_step);
    EXPECT_LT(error_of_estimate(with.estimate().value(), event.truth).position, 0.15);
    fix.at = fix.at - Duration{5'000'000};
    with.add(fix);
    EXPECT_EQ(count(with, Trouble::FixLate), 1);
  }
  EXPECT_LT(error_of_estimate(with.estimate().value(), truth).sigma,
            error_of_estimate(without.estimate().value(), truth).sigma);
}

/// Flies with fixes of 5 Hz from 6 s on: `fix_at` says where. @return the error of the estimate to the last of them, m
double error_to_fixes(const std::function<Vec3(double, const Vec3&)>& fix_at, std::int64_t* refused) {
  const Flight flight;
  Estimator estimator = flight.estimator();
  double due = 6.0, error = 0.0;
  for (const VioEvent& event : flight.events(4)) {
    give(estimator, event);
    if (!event.is_frame || event.t < due) continue;
    due += 0.2;
    PositionFix fix;
    fix.at = event.sample.at;
    fix.position = fix_at(event.t, event.truth.p);
    fix.variance = Vec3::Constant(0.0025);
    EXPECT_EQ(estimator.add(fix), InputOutcome::Used);
    error = (estimator.estimate()->pose_in_W().p - fix.position).norm();
  }
  *refused = count(estimator, Trouble::FixContradicts);
  return error;
}

TEST(EstimatorFlights, TenRefusedFixesThatAgreeAreBelieved) {
  std::int64_t refused = 0;
  const double error = error_to_fixes([](double, const Vec3& truth) { return Vec3(truth + Vec3(3, 1, 0)); }, &refused);
  EXPECT_EQ(refused, kBelievedFixes);
  EXPECT_LT(error, 0.3);
}

TEST(EstimatorFlights, FixesThatDisagreeOrStandStillAreNotBelieved) {
  std::int64_t refused = 0;
  int n = 0;
  EXPECT_GT(error_to_fixes([&](double, const Vec3& p) { return Vec3(p + Vec3(0, ++n % 2 ? 3 : -3, 0)); }, &refused),
            2.0);
  EXPECT_GT(refused, 40);
  EXPECT_GT(error_to_fixes([](double, const Vec3&) { return Vec3(100, 0, 0); }, &refused), 10.0);
  EXPECT_GT(refused, 40);
}

TEST(EstimatorFlights, SameInputsGiveTheSameBits) {
  Flight flight;
  flight.path.duration = 4.0;
  const auto events = flight.events(5);
  Estimator a = flight.estimator(), b = flight.estimator();
  for (const VioEvent& event : events) {
    give(a, event);
    give(b, event);
    Estimator copy = b;
    const auto x = a.estimate(), y = copy.estimate();
    ASSERT_EQ(x.has_value(), y.has_value());
    if (!x) continue;
    ASSERT_EQ(x->pose.p, y->pose.p);
    ASSERT_EQ(x->covariance, y->covariance);
  }
}

TEST(EstimatorFlights, FramesMayComeBeforeOrAfterTheirSamples) {
  Flight flight;
  flight.path.duration = 5.0;
  const auto events = flight.events(6);
  Estimator in_order = flight.estimator(), late = flight.estimator();
  std::vector<VioEvent> held;
  for (const VioEvent& event : events) {
    give(in_order, event);
    if (event.is_frame) {
      held.push_back(event);
      continue;
    }
    give(late, event);
    if (!held.empty() && event.t > held.front().t + 0.06) {
      give(late, held.front());
      held.erase(held.begin());
    }
  }
  for (const VioEvent& event : held) give(late, event);
  // The same corrections at the same times: only T_WO may have been cut elsewhere.
  EXPECT_LT((in_order.estimate()->pose_in_W().p - late.estimate()->pose_in_W().p).norm(), 1e-6);
  EXPECT_EQ(count(late, Trouble::FrameLate), 0);
}

/// Flies with inputs changed by `change`; returns the estimator.
Estimator flown(const std::function<void(VioEvent&)>& change, const Flight& flight = {}) {
  Estimator estimator = flight.estimator();
  for (VioEvent event : flight.events(7)) {
    change(event);
    give(estimator, event);
    const auto estimate = estimator.estimate();
    EXPECT_TRUE(!estimate || estimate->covariance.allFinite());
  }
  return estimator;
}

Flight short_flight() {
  Flight flight;
  flight.path.duration = 5.0;
  return flight;
}

TEST(EstimatorTroubles, AreSaidAndNeverCrash) {
  const Flight flight = short_flight();
  int n = 0;
  EXPECT_GT(count(flown(
                      [&](VioEvent& e) {
                        if (++n % 50 == 0) e.sample.angular_velocity.x() = kNaN;
                      },
                      flight),
                  Trouble::ImuNotFinite),
            0);
  EXPECT_GT(count(flown(
                      [&](VioEvent& e) {
                        if (e.is_frame && ++n % 5 == 0 && !e.frame.features.empty())
                          e.frame.features[0].left.x() = kNaN;
                      },
                      flight),
                  Trouble::FrameNotFinite),
            0);
  EXPECT_GT(count(flown(
                      [](VioEvent& e) {
                        for (StereoFeature& f : e.frame.features) std::swap(f.left, f.right);
                      },
                      flight),
                  Trouble::CamerasSwapped),
            50);
  EXPECT_GT(
      count(flown([](VioEvent& e) { e.frame.at = e.frame.at + Duration{2'000'000}; }, flight), Trouble::FrameAhead),
      50);
  EXPECT_GT(
      count(flown([](VioEvent& e) { e.frame.at = e.frame.at - Duration{2'000'000}; }, flight), Trouble::FrameLate), 50);
  FeatureFrame stuck;
  const Estimator after = flown(
      [&](VioEvent& e) {
        if (!e.is_frame || e.t < 3.0) return;
        if (stuck.features.empty()) stuck = e.frame;
        e.frame.features = stuck.features;
      },
      flight);
  EXPECT_GT(count(after, Trouble::CameraStuck), 20);
  EXPECT_EQ(after.estimate()->state, EstimatorState::Blind);
}

TEST(EstimatorTroubles, AWrongClockContradictsTheImu) {
  // 60 ms at the turns of this path: the filter refuses most features instead of believing them.
  Flight flight = short_flight();
  flight.path.yaw = [](double t) { return t <= 0.0 ? 0.0 : 0.8 * (1.0 - std::cos(2.0 * t)); };
  const Estimator estimator =
      flown([](VioEvent& e) { e.frame.at = e.frame.at + Duration{e.t > 0.5 ? 100'000 : 0}; }, flight);
  EXPECT_GT(count(estimator, Trouble::TracksContradict), 0);
}

TEST(EstimatorTroubles, ASaturatedImuWidensTheBound) {
  const Flight flight = short_flight();
  Estimator plain = flight.estimator(), saturated = flight.estimator();
  for (const VioEvent& event : flight.events(8)) {
    give(plain, event);
    if (event.is_frame) {
      saturated.add(event.frame);
      continue;
    }
    ImuSample sample = event.sample;
    const bool hit = event.t > 4.5 && event.t < 4.55;
    if (hit) sample.specific_force.x() = 30.0;
    saturated.add(sample, {30.0, 30.0});
    EXPECT_TRUE(!hit || count(saturated, Trouble::ImuSaturated) > 0);
    if (event.t > 4.55 && event.t < 4.5501) {
      EXPECT_GT(saturated.estimate()->covariance(kVelocityError, kVelocityError),
                4.0 * plain.estimate()->covariance(kVelocityError, kVelocityError));
    }
  }
}

TEST(EstimatorTroubles, AGapIsBridgedAndALongOneIsLost) {
  const Flight flight = short_flight();
  const auto gap = [&](double until) {
    Estimator estimator = flight.estimator();
    for (const VioEvent& event : flight.events(9)) {
      if (!event.is_frame && event.t > 3.0 && event.t < until) continue;
      give(estimator, event);
    }
    return estimator;
  };
  const Estimator bridged = gap(3.2), lost = gap(3.8);
  EXPECT_EQ(bridged.status().phase, EstimatorPhase::Moving);
  EXPECT_GE(count(bridged, Trouble::ImuGap), 1);
  EXPECT_EQ(lost.status().phase, EstimatorPhase::Lost);
  EXPECT_FALSE(lost.estimate().has_value());
}

TEST(EstimatorTroubles, AnImuClockThatStepsBackIsALongGap) {
  const Flight flight = short_flight();
  const auto stepped = [&](Duration back) {
    Estimator estimator = flight.estimator();
    for (VioEvent event : flight.events(9)) {
      if (event.t > 3.0) event.sample.at = event.sample.at - back;
      give(estimator, event);
      if (!event.is_frame && event.t > 1.0 && event.t < 2.0) {
        EXPECT_EQ(estimator.add(event.sample), InputOutcome::Refused) << "each one comes twice";
      }
    }
    return estimator;
  };
  EXPECT_EQ(stepped(Duration{0}).status().phase, EstimatorPhase::Moving);
  EXPECT_EQ(stepped(Duration{1'000'000}).status().phase, EstimatorPhase::Lost);
}

TEST(EstimatorStart, WaitsForRestAndStaysThere) {
  Flight flight;
  flight.path.rest = 4.0;
  flight.path.duration = 0.5;
  Estimator estimator = flight.estimator();
  bool rested = false;
  for (const VioEvent& event : flight.events(10)) {
    give(estimator, event);
    if (event.t < -0.01 && estimator.status().phase == EstimatorPhase::AtRest) {
      rested = true;
      EXPECT_LT((estimator.estimate()->pose.p - flight.path.start).norm(), 1e-9);
      EXPECT_NEAR(estimator.estimate()->gyro_bias.x(), event.truth.gyro_bias.x(), 2e-3);
    }
    EXPECT_FALSE(event.t < -2.7 && estimator.estimate().has_value());
  }
  EXPECT_TRUE(rested);
  EXPECT_EQ(estimator.status().phase, EstimatorPhase::Moving);
  for (int k = 0; k < kTroubles; ++k) EXPECT_LE(to_text(static_cast<Trouble>(k)).size(), 150u);
}

TEST(EstimatorOdometry, HasTheMessagesOrder) {
  Estimate estimate;
  for (int row = 0; row < kEstimateErrors; ++row) estimate.covariance(row, row) = row + 1.0;
  const Odometry odometry = to_odometry(estimate);
  EXPECT_EQ(odometry.pose_covariance[0], 4.0);   // position first
  EXPECT_EQ(odometry.pose_covariance[35], 3.0);  // then rotation
  EXPECT_EQ(odometry.velocity_covariance[4], 8.0);
}

}  // namespace
}  // namespace tern
