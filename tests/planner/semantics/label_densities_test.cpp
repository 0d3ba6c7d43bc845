#include "planner/semantics/label_densities.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "tests/support/effort.h"

namespace tern {
namespace {

/// The posterior by direct sums over all cells with their ages, and its maximum by a search over a fine grid.
class SlowPosterior {
 public:
  explicit SlowPosterior(double promised) : promised_(promised) {}
  void add(const SurfaceCell& cell, double t) { cells_.emplace_back(cell, t); }
  [[nodiscard]] double log_density_of(double density, double t) const {
    double sum = DensityPosterior(promised_).prior_area() * (promised_ * std::log(density) - density);
    for (const auto& [cell, at] : cells_) {
      const double weight = std::exp((at - t) / DensityPosterior::kForgotten), mean = density * cell.area_m2;
      sum += weight * (cell.has_landmark ? std::log(-std::expm1(-mean)) : -mean);
    }
    return sum;
  }
  [[nodiscard]] double density(double t) const {
    double best = 1e-4;
    for (double x = 1e-4; x < kMaxLandmarkDensity; x *= 1.002) {
      if (log_density_of(x, t) > log_density_of(best, t)) best = x;
    }
    return best;
  }

 private:
  double promised_;
  std::vector<std::pair<SurfaceCell, double>> cells_;
};

SurfaceCell random_cell(double density, Rng& rng) {
  SurfaceCell cell;
  cell.area_m2 = std::exp(rng.uniform(std::log(0.02), std::log(4.0)));
  cell.has_landmark = rng.uniform() < -std::expm1(-density * cell.area_m2);
  return cell;
}

TEST(DensityPosterior, IsThatOfDirectSums) {
  Rng rng(7);
  for (int k = 0; k < support::at_effort(100); ++k) {
    const double promised = std::exp(rng.uniform(std::log(0.03), std::log(8.0)));
    const double truth = std::exp(rng.uniform(std::log(0.03), std::log(8.0)));
    DensityPosterior posterior(promised);
    SlowPosterior slow(promised);
    double t = 0.0;
    for (int frame = 0; frame < 20; ++frame) {
      for (int n = 0; n < 15; ++n) {
        const SurfaceCell cell = random_cell(truth, rng);
        posterior.add(cell);
        slow.add(cell, t);
      }
      const double pause = rng.uniform(0.0, 5.0);
      t += pause;
      posterior.fade(pause);
    }
    EXPECT_NEAR(posterior.density() / slow.density(t), 1.0, 0.01) << "label " << promised << ", truth " << truth;
  }
}

TEST(DensityPosterior, OfSmallCellsIsTheGammaPosteriorsRatio) {
  DensityPosterior posterior(0.5);
  for (int k = 0; k < 400; ++k) posterior.add({kOpenGround, 0.002, k % 200 == 0});
  const double a = 0.5 * DensityPosterior::kPriorArea, b = DensityPosterior::kPriorArea;
  EXPECT_NEAR(posterior.density(), (a + 2.0) / (b + 400 * 0.002), 1e-3);
}

TEST(DensityPosterior, GoesBackToTheLabel) {
  DensityPosterior posterior(0.03);
  for (int k = 0; k < 300; ++k) posterior.add({kOpenGround, 0.3, k % 2 == 0});
  EXPECT_GT(posterior.density(), 1.0);
  posterior.fade(300.0);
  EXPECT_NEAR(posterior.density(), 0.03, 0.003);
}

TEST(DensityPosterior, HasAnEndForCellsThatAllHaveALandmark) {
  DensityPosterior posterior(0.0);
  EXPECT_LT(posterior.density(), 1e-3);
  for (int k = 0; k < 1000; ++k) posterior.add({kOpenGround, 5.0, true});
  EXPECT_LE(posterior.density(), kMaxLandmarkDensity);
  EXPECT_GT(posterior.density(), 0.1);
}

UTime second(double s) { return UTime{static_cast<std::int64_t>(s * 1e6)}; }

std::vector<SurfaceCell> frame_of(double density, SurfaceKind kind, Rng& rng) {
  std::vector<SurfaceCell> cells;
  for (int n = 0; n < 60; ++n) {
    cells.push_back(random_cell(density, rng));
    cells.back().kind = kind;
  }
  return cells;
}

TEST(LabelDensities, AreThoseOfTheLabelsUntilMoreIsSeen) {
  const SurfaceDensities promised{4.0, {1.0, 0.03}};
  LabelDensities densities(promised);
  EXPECT_FALSE(densities.in_force());
  Rng rng(3);
  int changes = 0;
  for (int k = 0; k < 20; ++k) changes += densities.add(frame_of(4.0, 1, rng), false, second(0.5 * k)) ? 1 : 0;
  ASSERT_TRUE(densities.in_force());
  EXPECT_NEAR(std::log(densities.in_force()->by_class[1] / 4.0), 0.0, std::log(1.8)) << "two steps at most";
  EXPECT_EQ(densities.in_force()->by_class[0], 1.0) << "bytes of the label";
  EXPECT_EQ(densities.in_force()->obstacles, 4.0);
  EXPECT_GE(changes, 1);
  EXPECT_LE(changes, 10) << "at most one per kHeld";
}

TEST(LabelDensities, OfTrueLabelsHardlyEverChange) {
  int changes = 0, frames = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Rng rng(seed);
    LabelDensities densities({4.0, {1.0, 0.03}});
    for (int k = 0; k < 60; ++k, ++frames)
      changes += densities.add(frame_of(1.0, kOpenGround, rng), false, second(0.5 * k)) ? 1 : 0;
  }
  EXPECT_LE(changes, frames / 100);
}

TEST(LabelDensities, AFullFrameMayRaiseButNotLower) {
  Rng rng(5);
  LabelDensities rich({4.0, {1.0}}), poor({4.0, {1.0}}), poor_and_full({4.0, {1.0}});
  for (int k = 0; k < 20; ++k) {
    (void)rich.add(frame_of(5.0, kOpenGround, rng), true, second(0.5 * k));
    const auto cells = frame_of(0.1, kOpenGround, rng);
    (void)poor.add(cells, false, second(0.5 * k));
    (void)poor_and_full.add(cells, true, second(0.5 * k));
  }
  EXPECT_GT(rich.seen(kOpenGround), 3.0);
  EXPECT_LT(poor.seen(kOpenGround), 0.3);
  EXPECT_NEAR(poor_and_full.seen(kOpenGround), 1.0, 1e-3);
}

}  // namespace
}  // namespace tern
