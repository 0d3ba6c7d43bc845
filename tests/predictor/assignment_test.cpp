#include "predictor/tracking/assignment.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <vector>

#include "core/base/random.h"

namespace tern {
namespace {

std::vector<int> assign(const Eigen::MatrixXd& cost, double gate) {
  std::vector<Pairing> pairings;
  for (Eigen::Index r = 0; r < cost.rows(); ++r) {
    for (Eigen::Index c = 0; c < cost.cols(); ++c) {
      pairings.push_back({static_cast<std::size_t>(r), static_cast<std::size_t>(c), cost(r, c)});
    }
  }
  return assign(static_cast<std::size_t>(cost.rows()), static_cast<std::size_t>(cost.cols()), pairings, gate);
}

double total(const Eigen::MatrixXd& cost, double gate, const std::vector<int>& column_of) {
  double sum = 0.0;
  for (std::size_t r = 0; r < column_of.size(); ++r) {
    sum += column_of[r] == kUnassigned ? gate : cost(static_cast<Eigen::Index>(r), column_of[r]);
  }
  return sum;
}

// Oracle: every way to give rows columns or nothing.
double least_total(const Eigen::MatrixXd& cost, double gate, Eigen::Index row, std::vector<bool>& used) {
  if (row == cost.rows()) return 0.0;
  double best = gate + least_total(cost, gate, row + 1, used);
  for (Eigen::Index c = 0; c < cost.cols(); ++c) {
    if (used[static_cast<std::size_t>(c)] || cost(row, c) > gate) continue;
    used[static_cast<std::size_t>(c)] = true;
    best = std::min(best, cost(row, c) + least_total(cost, gate, row + 1, used));
    used[static_cast<std::size_t>(c)] = false;
  }
  return best;
}

TEST(Assignment, IsAsCheapAsTheBestOfAll) {
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    Rng rng(seed);
    const auto rows = static_cast<Eigen::Index>(rng.uniform(0, 7)),
               columns = static_cast<Eigen::Index>(rng.uniform(0, 7));
    Eigen::MatrixXd cost(rows, columns);
    for (Eigen::Index i = 0; i < cost.size(); ++i) {
      cost(i) = rng.uniform() < 0.1 ? std::numeric_limits<double>::infinity() : rng.uniform(0.0, 30.0);
    }
    const std::vector<int> column_of = assign(cost, 20.0);
    ASSERT_EQ(column_of.size(), static_cast<std::size_t>(rows));
    std::vector<bool> used(static_cast<std::size_t>(columns), false);
    for (std::size_t r = 0; r < column_of.size(); ++r) {
      if (column_of[r] == kUnassigned) continue;
      ASSERT_FALSE(used[static_cast<std::size_t>(column_of[r])]) << "seed " << seed;
      used[static_cast<std::size_t>(column_of[r])] = true;
      ASSERT_LE(cost(static_cast<Eigen::Index>(r), column_of[r]), 20.0) << "seed " << seed;
    }
    std::fill(used.begin(), used.end(), false);
    ASSERT_NEAR(total(cost, 20.0, column_of), least_total(cost, 20.0, 0, used), 1e-9) << "seed " << seed;
  }
}

TEST(Assignment, PrefersTheSumToTheNearest) {
  Eigen::MatrixXd cost(2, 2);
  cost << 1.0, 2.0, 3.0, 9.0;  // greedy takes 1 + 9
  EXPECT_EQ(assign(cost, 20.0), (std::vector<int>{1, 0}));
}

TEST(Assignment, MakesNoPairBeyondTheGate) {
  Eigen::MatrixXd cost(2, 1);
  cost << 5.0, 25.0;
  EXPECT_EQ(assign(cost, 20.0), (std::vector<int>{0, kUnassigned}));
  EXPECT_EQ(assign(cost, 4.0), (std::vector<int>{kUnassigned, kUnassigned}));
}

TEST(Assignment, MakesTheCheapestPairsFirstInAGroupThatTheOptimumWouldTakeTooLongFor) {
  constexpr Eigen::Index kMany = 400;
  ASSERT_GT(2.0 * std::pow(kMany, 3), kMaxAssignmentSteps);
  Rng rng(1);
  Eigen::MatrixXd cost(kMany, kMany);
  for (Eigen::Index i = 0; i < cost.size(); ++i) cost(i) = rng.uniform(0.0, 20.0);
  Eigen::Index row = 0, column = 0;
  cost.minCoeff(&row, &column);
  const std::vector<int> column_of = assign(cost, 20.0);
  EXPECT_EQ(column_of[static_cast<std::size_t>(row)], column);
  EXPECT_EQ(std::set<int>(column_of.begin(), column_of.end()).size(), column_of.size()) << "each column once";
  EXPECT_FALSE(std::ranges::count(column_of, kUnassigned));
}

TEST(Assignment, TakesNothingToAssign) {
  EXPECT_TRUE(assign(Eigen::MatrixXd(0, 3), 1.0).empty());
  EXPECT_EQ(assign(Eigen::MatrixXd(2, 0), 1.0), (std::vector<int>{kUnassigned, kUnassigned}));
}

}  // namespace
}  // namespace tern
