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

/// Leaves of each run of ones the cells that have at least `length` − 1 ones before them.
void keep_runs(std::uint8_t* cells, int count, int stride, int length) {
  int run = 0;
  for (int k = 0; k < count; ++k, cells += stride) {
    run = *cells != 0 ? run + 1 : 0;
    *cells = run >= length ? 1 : 0;
  }
}

/// Sets the `length` − 1 cells before each one.
void mark_runs(std::uint8_t* cells, int count, int stride, int length) {
  int left = 0;
  for (int k = count - 1; k >= 0; --k) {
    std::uint8_t& cell = cells[static_cast<std::ptrdiff_t>(k) * stride];
    left = cell != 0 ? length : left - 1;
    cell = left > 0 ? 1 : 0;
  }
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

void UnseenField::shift(int dx, int dy) {
  std::vector<double>& old = rows_;
  old = d_;
  for (int iy = 0; iy < grid_.ny; ++iy) {
    for (int ix = 0; ix < grid_.nx; ++ix) {
      const int x = ix + dx, y = iy + dy;
      const bool was_inside = x >= 0 && y >= 0 && x < grid_.nx && y < grid_.ny;
      d_[index(ix, iy)] = was_inside ? old[index(x, y)] : 0.0;
    }
  }
  grid_.origin += grid_.cell * Eigen::Vector2d(dx, dy);
}

void UnseenField::find_candidates(const std::vector<SightFan>& fans, const std::vector<std::uint8_t>& filled) {
  const double k = kHalfDiagonal * grid_.cell;
  for (int iy = 0; iy < grid_.ny; ++iy) {
    for (int ix = 0; ix < grid_.nx; ++ix) {
      const std::size_t i = index(ix, iy);
      const auto sees = [&](const SightFan& fan) {
        return fan.sees_empty(grid_.centre(ix, iy), k + max_speed_ * fan.age_s);
      };
      const bool taken = !filled.empty() && filled[i] != 0;
      candidate_[i] = !taken && d_[i] <= k && std::none_of(fans.begin(), fans.end(), sees) ? 1 : 0;
    }
  }
}

/// Separable: squares of m × m candidates are found as runs of m along rows and then along columns, by their last cell.
/// Each such cell marks the m cells before it, along columns and then along rows. Beyond the grid all cells count.
void UnseenField::keep_blocks() {
  if (block_ == 1) {
    kept_ = candidate_;
    return;
  }
  const int pad = block_ - 1, columns = grid_.nx + 2 * pad, rows = grid_.ny + 2 * pad;
  padded_.assign(idx(columns * rows), 1);
  for (int iy = 0; iy < grid_.ny; ++iy) {
    std::copy_n(&candidate_[index(0, iy)], grid_.nx, &padded_[idx((iy + pad) * columns + pad)]);
  }
  for (int y = 0; y < rows; ++y) keep_runs(&padded_[idx(y * columns)], columns, 1, block_);
  for (int x = 0; x < columns; ++x) keep_runs(&padded_[idx(x)], rows, columns, block_);
  for (int x = 0; x < columns; ++x) mark_runs(&padded_[idx(x)], rows, columns, block_);
  for (int y = 0; y < rows; ++y) mark_runs(&padded_[idx(y * columns)], columns, 1, block_);
  for (int iy = 0; iy < grid_.ny; ++iy) {
    std::copy_n(&padded_[idx((iy + pad) * columns + pad)], grid_.nx, &kept_[index(0, iy)]);
  }
}

/// Separable: along rows the square of the least gap, then along columns the least sum. Beyond the grid all is kept.
void UnseenField::raise() {
  const int reach = static_cast<int>(std::ceil(kFarthest / grid_.cell)) + 1;
  const double most = kFarthest / grid_.cell * (kFarthest / grid_.cell);
  for (int iy = 0; iy < grid_.ny; ++iy) {
    int away = 0;
    for (int ix = 0; ix < grid_.nx; ++ix) {
      away = kept_[index(ix, iy)] != 0 ? 0 : away + 1;
      rows_[index(ix, iy)] = away;
    }
    away = 0;
    for (int ix = grid_.nx - 1; ix >= 0; --ix) {
      double& row = rows_[index(ix, iy)];
      away = kept_[index(ix, iy)] != 0 ? 0 : away + 1;
      row = std::min(most, squared_gap(std::min(away, static_cast<int>(row))));
    }
  }
  for (int iy = 0; iy < grid_.ny; ++iy) {
    least_.assign(idx(grid_.nx), std::min(most, squared_gap(std::min(iy + 1, grid_.ny - iy))));
    for (int y = std::max(0, iy - reach); y <= std::min(grid_.ny - 1, iy + reach); ++y) {
      const double gap = squared_gap(y - iy);
      const double* row = &rows_[index(0, y)];
      for (int ix = 0; ix < grid_.nx; ++ix) least_[idx(ix)] = std::min(least_[idx(ix)], row[ix] + gap);
    }
    for (int ix = 0; ix < grid_.nx; ++ix) {
      double& d = d_[index(ix, iy)];
      d = std::max(d, std::sqrt(least_[idx(ix)]) * grid_.cell);
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
