#include "tools/audit/unseen_space.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace tern::audit {
namespace {

constexpr double kEdge = 0.125;  // of a cell, m
constexpr int kSide = 128;       // cells per edge of the window
constexpr int kStep = 8;         // cells by which the window moves
constexpr double kMost = 4.0;    // larger bounds are not told apart, m
constexpr int kBins = 1440;      // directions
constexpr double kLevel = 0.02;  // largest tilt of a level frame, rad
constexpr Duration kPeriod{90'000};
constexpr double kTurn = 2.0 * std::numbers::pi;

int bin_of(double azimuth) {
  return static_cast<int>(std::floor((azimuth / kTurn - std::floor(azimuth / kTurn)) * kBins));
}

/// The free range of one cell of the picture: its depth less 3σ, at its azimuth nearest to the axis.
double free_range(const SensorView& view, std::int16_t cell, double from, double to) {
  if (cell == kBlindDepth) return 0.0;
  const double depth = cell == kFarDepth ? view.range_m : std::min(view.range_m, cell * view.unit_m);
  const double sure = depth - 3.0 * (view.depth_sigma + view.depth_sigma_per_square_m * depth * depth);
  const double off_axis = from * to < 0.0 ? 0.0 : std::min(std::abs(from), std::abs(to));
  return std::max(0.0, view.kind == ViewKind::Pinhole ? sure / std::cos(off_axis) : sure);
}

/// The free range in each direction of the horizontal plane, or nothing if the frame is not level. A direction that
/// the picture covers in part has the range 0.
std::vector<double> ranges_of(const SensorView& view) {
  const Eigen::Quaterniond q(view.q_WC[0], view.q_WC[1], view.q_WC[2], view.q_WC[3]);
  const Vec3 y = q * Vec3::UnitY(), z = q * Vec3::UnitZ();
  if (view.rows < 1 || view.columns < 1 || view.up <= 0.0 || view.down <= 0.0) return {};
  if (std::acos(std::clamp(-y.z(), -1.0, 1.0)) > kLevel) return {};
  const bool flat = view.kind == ViewKind::Pinhole;
  const auto scale = [flat](double angle) { return flat ? std::tan(angle) : angle; };
  const auto angle = [flat](double place) { return flat ? std::atan(place) : place; };
  const double up = scale(view.up), down = scale(view.down), left = scale(view.left), right = scale(view.right);
  const int row = std::clamp(static_cast<int>(up / (up + down) * view.rows), 0, view.rows - 1);
  const double ahead = std::atan2(z.y(), z.x());
  std::vector<double> ranges(kBins, 0.0);
  std::vector<double> covered(kBins, 0.0);  // rad
  std::vector<double> least(kBins, view.range_m);
  for (int k = 0; k < view.columns; ++k) {
    const double from = angle(-left + (left + right) * k / view.columns);  // to the right
    const double to = angle(-left + (left + right) * (k + 1) / view.columns);
    const double range = free_range(view, view.depths[idx(row * view.columns + k)], from, to);
    double low = ahead - to;  // W counts to the left
    const double high = ahead - from;
    while (low < high - 1e-12) {
      const double end = std::min(high, (std::floor(low / kTurn * kBins + 1e-9) + 1.0) * kTurn / kBins);
      const auto bin = idx(bin_of(0.5 * (low + end)));
      least[bin] = std::min(least[bin], range);
      covered[bin] += end - low;
      low = end;
    }
  }
  for (std::size_t b = 0; b < ranges.size(); ++b) {
    if (covered[b] > kTurn / kBins - 1e-7) ranges[b] = least[b];
  }
  return ranges;
}

}  // namespace

std::size_t UnseenSpace::slot(Cell c) const { return idx((c.y - corner_.y) * kSide + c.x - corner_.x); }

Eigen::Vector2d UnseenSpace::centre(Cell c) const { return origin_ + kEdge * Eigen::Vector2d(c.x + 0.5, c.y + 0.5); }

void UnseenSpace::place_window(const Eigen::Vector2d& eye) {
  const Eigen::Vector2d middle = origin_ + kEdge * Eigen::Vector2d(corner_.x + kSide / 2, corner_.y + kSide / 2);
  const Eigen::Vector2d steps = ((eye - middle) / (kStep * kEdge)).array().round();
  const Cell before = corner_;
  corner_ = {before.x + kStep * static_cast<int>(steps.x()), before.y + kStep * static_cast<int>(steps.y())};
  std::vector<double> moved(bound_.size(), 0.0);
  for (int k = 0; k < kSide * kSide; ++k) {
    const Cell c{corner_.x + k % kSide, corner_.y + k / kSide};
    const int x = c.x - before.x, y = c.y - before.y;
    if (x >= 0 && y >= 0 && x < kSide && y < kSide) moved[slot(c)] = bound_[idx(y * kSide + x)];
  }
  bound_ = std::move(moved);
}

void UnseenSpace::add(const SightingSet& frame) {
  const std::pair sensor(frame.header.name.sender_epoch_us, frame.sensor_id);
  const auto before = used_.find(sensor);
  if (before != used_.end() && frame.at - before->second < kPeriod) return;
  const std::vector<double> ranges = ranges_of(frame.view);
  if (ranges.empty()) return;
  used_[sensor] = frame.at;
  const Eigen::Vector2d eye = frame.view.sensor_position.head<2>();
  if (frames_++ == 0) {
    at_ = frame.at;
    origin_ = eye - Eigen::Vector2d::Constant(0.5 * kSide * kEdge);
    bound_.assign(idx(kSide * kSide), 0.0);
    const double clear = (eye - start_).norm() <= mover_.clear_radius ? mover_.clear_radius : 0.0;
    for (int k = 0; k < kSide * kSide; ++k) {
      bound_[idx(k)] = std::max(0.0, clear - (centre({k % kSide, k / kSide}) - eye).norm());
    }
  }
  place_window(eye);
  const UTime now = std::max(at_, frame.at);
  for (double& bound : bound_) bound = std::max(0.0, bound - mover_.max_speed * (now - at_).seconds());
  at_ = now;
  const double nearest =
      frame.view.near_m /
      (frame.view.kind == ViewKind::Pinhole ? std::cos(std::max(frame.view.left, frame.view.right)) : 1.0);
  std::vector<bool> cells = unseen_cells(ranges, eye, nearest, (now - frame.at).seconds());
  keep_where_movers_fit(cells);
  raise(cells);
}

/// Cells that may hold a part of somebody: the bound does not exclude it, and the picture does not show them empty.
std::vector<bool> UnseenSpace::unseen_cells(const std::vector<double>& ranges, const Eigen::Vector2d& eye,
                                            double nearest, double age_s) const {
  const double half_diagonal = kEdge * std::sqrt(0.5), r = half_diagonal + mover_.max_speed * age_s;
  std::vector<bool> cells(bound_.size());
  for (int k = 0; k < kSide * kSide; ++k) {
    const Cell c{corner_.x + k % kSide, corner_.y + k / kSide};
    if (bound_[slot(c)] > half_diagonal) continue;
    const Eigen::Vector2d to = centre(c) - eye;
    const double away = to.norm();
    bool empty = away - r >= nearest && away > r;
    if (empty) {
      const double turn = std::atan2(to.y(), to.x()), half = std::asin(r / away), bin = kTurn / kBins;
      for (double a = turn - half; empty && a < turn + half + bin; a += bin) {
        empty = ranges[idx(bin_of(std::min(a, turn + half)))] >= away + r;
      }
    }
    cells[slot(c)] = !empty;
  }
  return cells;
}

/// Keeps the cells of squares of m × m cells, by sums over rectangles. All cells beyond the window count.
void UnseenSpace::keep_where_movers_fit(std::vector<bool>& cells) const {
  const int m = std::max(1, static_cast<int>(std::ceil(mover_.least_width / kEdge - 1e-9)));
  const int side = kSide + 2 * m;
  const auto summed = [side](auto&& is_one) {
    std::vector<int> sums(idx((side + 1) * (side + 1)), 0);
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        sums[idx((y + 1) * (side + 1) + x + 1)] = (is_one(x, y) ? 1 : 0) + sums[idx(y * (side + 1) + x + 1)] +
                                                  sums[idx((y + 1) * (side + 1) + x)] - sums[idx(y * (side + 1) + x)];
      }
    }
    return [sums = std::move(sums), side](int x0, int y0, int x1, int y1) {
      return sums[idx(y1 * (side + 1) + x1)] - sums[idx(y0 * (side + 1) + x1)] - sums[idx(y1 * (side + 1) + x0)] +
             sums[idx(y0 * (side + 1) + x0)];
    };
  };
  const auto holds = summed([&](int x, int y) {
    const bool inside = x >= m && y >= m && x < m + kSide && y < m + kSide;
    return !inside || cells[idx((y - m) * kSide + x - m)];
  });
  const auto is_corner =
      summed([&](int x, int y) { return x + m <= side && y + m <= side && holds(x, y, x + m, y + m) == m * m; });
  for (int k = 0; k < kSide * kSide; ++k) {
    const int x = k % kSide + m, y = k / kSide + m;
    cells[idx(k)] = is_corner(x - m + 1, y - m + 1, x + 1, y + 1) > 0;
  }
}

/// The distance to the nearest square that may hold somebody, along rows first. Beyond the window all do.
void UnseenSpace::raise(const std::vector<bool>& cells) {
  constexpr int kReach = static_cast<int>(kMost / kEdge) + 1;
  const auto gap = [](int cells_away) { return std::max(0.0, kEdge * (cells_away - 0.5)); };
  std::vector<double> row(idx(kSide * kSide));
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      int away = 0;
      while (away <= kReach) {
        const int a = x - away, b = x + away;
        if (a < 0 || b >= kSide || cells[idx(y * kSide + a)] || cells[idx(y * kSide + b)]) break;
        ++away;
      }
      row[idx(y * kSide + x)] = std::min(kMost, gap(away));
    }
  }
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      double least = kMost;
      for (int away = 0; away <= kReach && gap(away) < least; ++away) {
        for (const int other : {y - away, y + away}) {
          const bool inside = other >= 0 && other < kSide;
          least = std::min(least, inside ? std::hypot(row[idx(other * kSide + x)], gap(away)) : gap(away));
        }
      }
      double& bound = bound_[idx(y * kSide + x)];
      bound = std::max(bound, least);
    }
  }
}

double UnseenSpace::distance(const Eigen::Vector2d& p) const {
  if (bound_.empty()) return 0.0;
  const Eigen::Vector2d place = (p - origin_) / kEdge - Eigen::Vector2d(corner_.x, corner_.y);
  if ((place.array() < 0.0).any() || (place.array() >= kSide).any()) return 0.0;
  double most = 0.0;
  for (int k = 0; k < 9; ++k) {
    const int x = static_cast<int>(place.x()) + k % 3 - 1, y = static_cast<int>(place.y()) + k / 3 - 1;
    if (x < 0 || y < 0 || x >= kSide || y >= kSide) continue;
    const Cell c{corner_.x + x, corner_.y + y};
    most = std::max(most, bound_[slot(c)] - (p - centre(c)).norm());
  }
  return most;
}

}  // namespace tern::audit
