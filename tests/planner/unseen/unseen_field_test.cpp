#include "planner/unseen/unseen_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/base/random.h"
#include "tests/support/effort.h"

namespace tern {
namespace {

using Vec2 = Eigen::Vector2d;
using Square = Eigen::AlignedBox2d;

constexpr UTime kZero{1'700'000'000'000'000};

/// Walls that hide, and a vehicle among them.
struct Place {
  UnseenGrid grid{Vec2(-6, -6), 0.25, 48, 48};
  std::vector<Square> walls;
  std::vector<std::uint8_t> filled;

  explicit Place(Rng& rng) {
    for (int k = 0; k < 10; ++k) {
      const Vec2 c(rng.uniform(-6, 6), rng.uniform(-6, 6)), h(rng.uniform(0.1, 1.2), rng.uniform(0.1, 1.2));
      if (Square(c - h, c + h).exteriorDistance(Vec2(0, 0)) > 1.0) walls.emplace_back(c - h, c + h);
    }
    for (int iy = 0; iy < grid.ny; ++iy) {
      for (int ix = 0; ix < grid.nx; ++ix) filled.push_back(is_filled(cell(ix, iy)) ? 1 : 0);
    }
  }
  [[nodiscard]] Square cell(int ix, int iy) const {
    const Vec2 c = grid.centre(ix, iy), h = Vec2::Constant(0.5 * grid.cell);
    return {c - h, c + h};
  }
  [[nodiscard]] bool is_filled(const Square& cell) const {
    return std::any_of(walls.begin(), walls.end(), [&](const Square& w) { return w.contains(cell); });
  }
  [[nodiscard]] bool has_room(const Square& mover) const {
    return std::none_of(walls.begin(), walls.end(), [&](const Square& w) { return w.intersects(mover); });
  }
  [[nodiscard]] double free_range(const Vec2& eye, double azimuth, double range) const {
    const Vec2 ray(std::cos(azimuth), std::sin(azimuth));
    for (const Square& w : walls) {
      double in = 0.0, out = range;
      for (int axis = 0; axis < 2; ++axis) {
        const double a = (w.min()[axis] - eye[axis]) / ray[axis], b = (w.max()[axis] - eye[axis]) / ray[axis];
        in = std::max(in, std::min(a, b));
        out = std::min(out, std::max(a, b));
      }
      if (in <= out) range = std::min(range, in);
    }
    return range;
  }
  [[nodiscard]] SightFan look(const Vec2& eye, double yaw, double half, double range) const {
    constexpr int kSectors = 90;
    SightFan fan{eye, yaw - half, 2.0 * half / kSectors, 0.2, 0.0, {}};
    for (int k = 0; k < kSectors; ++k) {
      double reach = range;
      for (int r = 0; r <= 4; ++r)
        reach = std::min(reach, free_range(eye, fan.first + (k + 0.25 * r) * fan.width, range));
      fan.reach.push_back(reach);
    }
    return fan;
  }
};

struct Adversary {
  Vec2 p;
  bool chases = true;
  bool is_out = false;
};

Square body_of(const Adversary& a, double width) {
  return {a.p - Vec2::Constant(0.5 * width), a.p + Vec2::Constant(0.5 * width)};
}

/// Whether a mover has a part in a cell that a picture showed to be empty: it would have been in the picture.
bool is_seen(const Place& place, const std::vector<std::uint8_t>& seen_empty, const Square& mover) {
  const auto index = [&](double x, double low) { return static_cast<int>(std::floor((x - low) / place.grid.cell)); };
  const int x0 = std::max(0, index(mover.min().x(), place.grid.origin.x()));
  const int x1 = std::min(place.grid.nx - 1, index(mover.max().x(), place.grid.origin.x()));
  const int y0 = std::max(0, index(mover.min().y(), place.grid.origin.y()));
  const int y1 = std::min(place.grid.ny - 1, index(mover.max().y(), place.grid.origin.y()));
  for (int iy = y0; iy <= y1; ++iy) {
    for (int ix = x0; ix <= x1; ++ix) {
      if (seen_empty[static_cast<std::size_t>(iy * place.grid.nx + ix)] != 0) return true;
    }
  }
  return false;
}

std::vector<std::uint8_t> cells_seen_empty(const UnseenGrid& grid, const SightFan& fan) {
  std::vector<std::uint8_t> flags;
  for (int iy = 0; iy < grid.ny; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix) {
      flags.push_back(fan.sees_empty(grid.centre(ix, iy), grid.cell * std::sqrt(0.5)) ? 1 : 0);
    }
  }
  return flags;
}

/// 1500 movers, outside walls and at least 2 m from the vehicle.
std::vector<Adversary> adversaries(Rng& rng, const Place& place, double width) {
  std::vector<Adversary> all;
  while (all.size() < 1500) {
    const Adversary a{Vec2(rng.uniform(-8, 8), rng.uniform(-8, 8)), rng.uniform() < 0.6};
    const Square body = body_of(a, width);
    if (place.has_room(body) && body.exteriorDistance(Vec2(0, 0)) >= 2.0) all.push_back(a);
  }
  return all;
}

/// Straight ahead from p, then to rest.
TimedSpline braking(const Vec2& p, const Vec2& v) {
  TimedSpline t{kZero, Duration{250'000}, Points::Zero(3, 7)};
  MotionSample start;
  start.p.head<2>() = p;
  start.v.head<2>() = v;
  t.control_points.leftCols<3>() = start_control_points(start, 0.25);
  for (int k = 3; k < 7; ++k) t.control_points.col(k) = t.control_points.col(2);
  return t;
}

/// Adversaries of the largest speed start wherever nobody is known to be absent, chase the vehicle or wander, and leave
/// when they are seen.
TEST(UnseenField, NoAdversaryIsEverNearerThanItSaysNorTouchesTheVehicleWhileAPlanIsClear) {
  constexpr double kDt = 0.1, kBody = 0.2, kLatency = 0.05;
  std::int64_t checks = 0, clear_plans = 0;
  double slack = std::numeric_limits<double>::infinity();
  for (int world = 0; world < support::listed_at_effort(6, 100); ++world) {
    Rng rng(static_cast<std::uint64_t>(100 + world));
    const Place place(rng);
    const double w = rng.uniform(0.3, 2.5), width = world % 2 == 0 ? 0.0 : rng.uniform(0.26, 0.9);
    const double half = world % 3 == 0 ? std::numbers::pi : rng.uniform(0.5, 1.6);
    UnseenField field(place.grid, w, width);
    field.clear_ball(Vec2::Zero(), 2.0);
    std::vector<Adversary> all = adversaries(rng, place, width);
    Vec2 p(0, 0), v(1, 0);
    double yaw = 0.0;
    for (int frame = 0; frame < 50; ++frame) {
      const std::vector<SightFan> fans{place.look(p, yaw, half, 6.0)};
      field.update(frame == 0 ? 0.0 : kDt, fans, place.filled);
      const std::vector<std::uint8_t> seen_empty = cells_seen_empty(place.grid, fans[0]);
      const TimedSpline plan = braking(p, v);
      const double clear_s = clear_until(plan, kZero, field, kLatency, kBody);
      clear_plans += clear_s >= plan.spline().duration_s() ? 1 : 0;
      const Vec2 probe = p + Vec2(rng.uniform(-3, 3), rng.uniform(-3, 3));
      for (Adversary& a : all) {
        const Square body = body_of(a, width);
        a.is_out = a.is_out || is_seen(place, seen_empty, body);
        if (a.is_out) continue;
        for (const Vec2& x : {p, probe}) {
          ASSERT_LE(field.distance(x), body.exteriorDistance(x) + 1e-9) << "world " << world << ", frame " << frame;
        }
        const Vec2 cell = ((a.p - place.grid.origin) / place.grid.cell).array().floor();
        const int ix = static_cast<int>(cell.x()), iy = static_cast<int>(cell.y());
        if (ix >= 0 && iy >= 0 && ix < place.grid.nx && iy < place.grid.ny) {
          ASSERT_LE(field.at(ix, iy), body.exteriorDistance(place.grid.centre(ix, iy)) + 1e-9);
        }
        slack = std::min(slack, body.exteriorDistance(p) - field.distance(p));
        for (double s = 0.0; s < clear_s; s += 0.05) {
          const Vec2 there = plan.spline().sample(s).p.head<2>();
          ASSERT_GT(body.exteriorDistance(there), kBody + w * s) << "touched before the plan ceases to be clear";
        }
        ++checks;
        const double turn = a.chases ? std::atan2(p.y() - a.p.y(), p.x() - a.p.x()) : rng.uniform(-3.2, 3.2);
        Adversary moved = a;
        moved.p += w * kDt * Vec2(std::cos(turn), std::sin(turn));
        if (place.has_room(body_of(moved, width))) a = moved;
      }
      yaw += rng.uniform(-0.3, 0.3);
      v = 1.5 * Vec2(std::cos(yaw), std::sin(yaw));
      const Vec2 next = p + kDt * v;
      if (place.has_room(Square(next - Vec2::Constant(0.3), next + Vec2::Constant(0.3))) && next.norm() < 5.0) p = next;
    }
  }
  EXPECT_GT(checks, 50'000);
  EXPECT_GT(clear_plans, 0) << "a rule that never clears a plan proves nothing";
  EXPECT_LT(slack, 0.5) << "some adversary is nearly as near as the field allows";
}

TEST(UnseenField, DoesNotGrowByWaitingAndClosesInAtTheSpeedOfMovers) {
  UnseenField field({Vec2(-4, -4), 0.25, 32, 32}, 1.0, 0.0);
  field.clear_ball(Vec2::Zero(), 2.0);
  const double before = field.distance(Vec2::Zero());
  EXPECT_NEAR(before, 2.0, 0.36);
  field.update(0.5, {});
  EXPECT_LE(field.distance(Vec2::Zero()), before - 0.5 + 0.36);
  EXPECT_GE(field.distance(Vec2::Zero()), before - 0.5 - 1e-9);
  field.update(5.0, {});
  EXPECT_EQ(field.distance(Vec2::Zero()), 0.0);
}

TEST(UnseenField, SaysNothingBeyondItsGridAndBeforeItsFirstPicture) {
  UnseenField field({Vec2(-4, -4), 0.25, 32, 32}, 1.0, 0.0);
  EXPECT_EQ(field.distance(Vec2(0, 0)), 0.0);
  field.clear_ball(Vec2(5, 0), 4.0);
  EXPECT_EQ(field.distance(Vec2(5, 0)), 0.0);
  EXPECT_GT(field.distance(Vec2(3, 0)), 1.0);
}

TEST(UnseenField, AMoverDoesNotFitIntoAGapNarrowerThanItself) {
  const UnseenGrid grid{Vec2(-4, -4), 0.25, 32, 32};
  std::vector<std::uint8_t> filled(32 * 32, 1);
  filled[16 * 32 + 16] = 0;  // one free cell in a block of stone, which ends before the grid does
  for (int k = 0; k < 32; ++k) filled[static_cast<std::size_t>(k)] = filled[static_cast<std::size_t>(k * 32)] = 1;
  UnseenField narrow(grid, 1.0, 0.0), wide(grid, 1.0, 0.5);
  narrow.update(0.0, {}, filled);
  wide.update(0.0, {}, filled);
  EXPECT_EQ(narrow.at(16, 16), 0.0);
  EXPECT_GT(wide.at(16, 16), 3.0);
}

/// Blocks of candidates by the definition: all places of the block, one after the other.
TEST(UnseenField, KeepsExactlyTheCandidatesThatABlockOfThemCovers) {
  Rng rng(4);
  for (int round = 0; round < 12; ++round) {
    const UnseenGrid grid{Vec2(0, 0), 0.25, 20 + round, 26 - round};
    const int m = 1 + round % 4;
    std::vector<std::uint8_t> filled;
    for (int k = 0; k < grid.nx * grid.ny; ++k) filled.push_back(rng.uniform() < 0.25 ? 1 : 0);
    UnseenField field(grid, 1.0, m * grid.cell);
    field.update(0.0, {}, filled);
    const auto may_hold = [&](int x, int y) {
      const bool inside = x >= 0 && y >= 0 && x < grid.nx && y < grid.ny;
      return !inside || filled[static_cast<std::size_t>(y * grid.nx + x)] == 0;
    };
    const auto is_covered = [&](int ix, int iy) {
      for (int k = 0; k < m * m; ++k) {
        bool whole = true;
        for (int j = 0; whole && j < m * m; ++j) whole = may_hold(ix - k % m + j % m, iy - k / m + j / m);
        if (whole) return true;
      }
      return false;
    };
    for (int iy = 0; iy < grid.ny; ++iy) {
      for (int ix = 0; ix < grid.nx; ++ix) {
        ASSERT_EQ(field.at(ix, iy) == 0.0, is_covered(ix, iy)) << "round " << round << " at " << ix << ", " << iy;
      }
    }
  }
}

TEST(UnseenField, ShiftedByWholeCellsKeepsWhatItKnewInItsPlace) {
  UnseenField field({Vec2(-4, -4), 0.25, 32, 32}, 1.0, 0.0);
  field.clear_ball(Vec2(1, 0.5), 2.0);
  const UnseenField before = field;
  field.shift(6, -3);
  EXPECT_EQ(field.grid().origin, Vec2(-4 + 6 * 0.25, -4 - 3 * 0.25));
  for (double x = -0.9; x < 3.0; x += 0.37)
    EXPECT_NEAR(field.distance(Vec2(x, 0.4)), before.distance(Vec2(x, 0.4)), 1e-12);
  EXPECT_EQ(field.distance(Vec2(5, 0)), 0.0) << "nobody is known to be absent in cells that enter the window";
}

TEST(UnseenField, ALatePictureShowsLessByTheWayThatMoversGoInItsAge) {
  const UnseenGrid grid{Vec2(-4, -4), 0.25, 32, 32};
  SightFan fan{Vec2(0, 0), -3.14159265, 2.0 * std::numbers::pi / 90, 0.0, 0.0, std::vector<double>(90, 3.0)};
  UnseenField fresh(grid, 1.0, 0.0), late(grid, 1.0, 0.0);
  fresh.update(0.0, {fan});
  fan.age_s = 0.5;
  late.update(0.0, {fan});
  const Vec2 at(1.0, 0.0);
  EXPECT_NEAR(late.distance(at), fresh.distance(at) - 0.5, 0.3);
  EXPECT_LT(late.distance(at), fresh.distance(at) - 0.2);
}

/// The squares of all cells that may hold somebody, one after the other.
TEST(UnseenField, IsTheDistanceToTheNearestSquareThatMayHoldSomebody) {
  Rng rng(3);
  const UnseenGrid grid{Vec2(0, 0), 0.25, 40, 36};
  std::vector<std::uint8_t> filled;
  for (int k = 0; k < grid.nx * grid.ny; ++k) filled.push_back(rng.uniform() < 0.97 ? 1 : 0);
  UnseenField field(grid, 1.0, 0.0);
  field.update(0.0, {}, filled);
  for (int k = 0; k < 300; ++k) {
    const int ix = static_cast<int>(rng.uniform(0, grid.nx)), iy = static_cast<int>(rng.uniform(0, grid.ny));
    const Vec2 c = grid.centre(ix, iy);
    const Vec2 high = grid.origin + grid.cell * Vec2(grid.nx, grid.ny);
    double least = std::min({UnseenField::kFarthest, (c - grid.origin).minCoeff(), (high - c).minCoeff()});
    for (int j = 0; j < grid.nx * grid.ny; ++j) {
      if (filled[static_cast<std::size_t>(j)] != 0) continue;
      const Vec2 o = grid.centre(j % grid.nx, j / grid.nx), h = Vec2::Constant(0.5 * grid.cell);
      least = std::min(least, Square(o - h, o + h).exteriorDistance(c));
    }
    EXPECT_NEAR(field.at(ix, iy), least, 1e-9);
  }
}

}  // namespace
}  // namespace tern
