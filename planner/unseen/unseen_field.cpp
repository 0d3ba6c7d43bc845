#include "planner/unseen/unseen_field.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tern {
namespace {

/// Half the diagonal of a square, in edges.
const double kHalfDiagonal = std::sqrt(0.5);

/// The square of the gap between a cell's centre and a cell that is this many rows (or columns) away, in edges.
double squared_gap(int away) {
  const double gap = std::max(0.0, std::abs(away) - 0.5);
  return gap * gap;
}

}  // namespace

UnseenField::UnseenField(const UnseenGrid& grid, double max_speed, double least_width)
    : grid_(grid),
      max_speed_(max_speed),
      block_(std::max(1, static_cast<int>(std::ceil(least_width / grid.cell - 1e-9)))) {
  if (grid.nx < 1 || grid.ny < 1 || !(grid.cell > 0.0)) throw std::invalid_argument("a grid needs cells");
  const auto cells = static_cast<std::size_t>(grid.nx) * static_cast<std::size_t>(grid.ny);
  d_.assign(cells, 0.0);
  candidate_.assign(cells, 0);
  kept_.assign(cells, 0);
  rows_.assign(cells, 0.0);
}

void UnseenField::clear_ball(const Eigen::Vector2d& centre, double radius) {
  for (int iy = 0; iy < grid_.ny; ++iy) {
    for (int ix = 0; ix < grid_.nx; ++ix) {
      double& d = d_[index(ix, iy)];
      d = std::max(d, radius - (grid_.centre(ix, iy) - centre).norm());
    }
  }
}

void UnseenField::find_candidates(const std::vector<SightFan>& fans, const std::vector<std::uint8_t>& filled) {
  const double k = kHalfDiagonal * grid_.cell;
  for (int iy = 0; iy < grid_.ny; ++iy) {
    for (int ix = 0; ix < grid_.nx; ++ix) {
      const std::size_t i = index(ix, iy);
      const auto sees = [&](const SightFan& fan) { return fan.sees_empty(grid_.centre(ix, iy), k); };
      const bool taken = !filled.empty() && filled[i] != 0;
      candidate_[i] = !taken && d_[i] <= k && std::none_of(fans.begin(), fans.end(), sees) ? 1 : 0;
    }
  }
}

void UnseenField::keep_blocks() {
  std::fill(kept_.begin(), kept_.end(), std::uint8_t{0});
  const auto may_hold = [&](int ix, int iy) {
    const bool inside = ix >= 0 && iy >= 0 && ix < grid_.nx && iy < grid_.ny;
    return !inside || candidate_[index(ix, iy)] != 0;
  };
  for (int iy = 1 - block_; iy < grid_.ny; ++iy) {
    for (int ix = 1 - block_; ix < grid_.nx; ++ix) {
      bool whole = true;
      for (int k = 0; whole && k < block_ * block_; ++k) whole = may_hold(ix + k % block_, iy + k / block_);
      if (!whole) continue;
      for (int k = 0; k < block_ * block_; ++k) {
        const int x = ix + k % block_, y = iy + k / block_;
        if (x >= 0 && y >= 0 && x < grid_.nx && y < grid_.ny) kept_[index(x, y)] = 1;
      }
    }
  }
}

/// Separable: along rows the square of the least gap, then along columns the least sum. Beyond the grid all is kept.
void UnseenField::raise() {
  const int reach = static_cast<int>(std::ceil(kFarthest / grid_.cell)) + 1;
  const double most = kFarthest / grid_.cell * (kFarthest / grid_.cell);
  for (int iy = 0; iy < grid_.ny; ++iy) {
    for (int ix = 0; ix < grid_.nx; ++ix) {
      double least = std::min(most, squared_gap(std::min(ix + 1, grid_.nx - ix)));
      for (int x = std::max(0, ix - reach); x <= std::min(grid_.nx - 1, ix + reach); ++x) {
        if (kept_[index(x, iy)] != 0) least = std::min(least, squared_gap(x - ix));
      }
      rows_[index(ix, iy)] = least;
    }
  }
  for (int iy = 0; iy < grid_.ny; ++iy) {
    for (int ix = 0; ix < grid_.nx; ++ix) {
      double least = std::min(most, squared_gap(std::min(iy + 1, grid_.ny - iy)));
      for (int y = std::max(0, iy - reach); y <= std::min(grid_.ny - 1, iy + reach); ++y) {
        least = std::min(least, rows_[index(ix, y)] + squared_gap(y - iy));
      }
      double& d = d_[index(ix, iy)];
      d = std::max(d, std::sqrt(least) * grid_.cell);
    }
  }
}

void UnseenField::update(double dt_s, const std::vector<SightFan>& fans, const std::vector<std::uint8_t>& filled) {
  for (double& d : d_) d = std::max(0.0, d - max_speed_ * dt_s);
  find_candidates(fans, filled);
  keep_blocks();
  raise();
}

double UnseenField::distance(const Eigen::Vector2d& p) const {
  const Eigen::Vector2d at = (p - grid_.origin) / grid_.cell;
  if (at.x() < 0.0 || at.y() < 0.0 || at.x() >= grid_.nx || at.y() >= grid_.ny) return 0.0;
  const int x0 = static_cast<int>(std::floor(at.x() - 0.5)), y0 = static_cast<int>(std::floor(at.y() - 0.5));
  double most = 0.0;
  for (int k = 0; k < 4; ++k) {
    const int ix = x0 + k % 2, iy = y0 + k / 2;
    if (ix < 0 || iy < 0 || ix >= grid_.nx || iy >= grid_.ny) continue;
    most = std::max(most, d_[index(ix, iy)] - (p - grid_.centre(ix, iy)).norm());
  }
  return most;
}

double clear_until(const TimedSpline& trajectory, UTime from, const UnseenField& field, double latency_s, double radius,
                   double step_s) {
  const ClampedSpline spline = trajectory.spline();
  const double begin = std::max(0.0, (from - trajectory.start).seconds());
  const double length = std::max(0.0, spline.duration_s() - begin);
  const int steps = static_cast<int>(std::ceil(length / step_s));
  for (int k = 0; k <= steps; ++k) {
    const double s = std::min(length, k * step_s);
    const MotionSample m = spline.sample(begin + s);
    const double margin = 0.5 * step_s * (m.v.head<2>().norm() + field.max_speed());
    if (field.distance(m.p.head<2>()) - field.max_speed() * (s + latency_s) <= radius + margin) return s;
  }
  return length;
}

}  // namespace tern
