#include "planner/global_path/grid_axis.h"

#include <algorithm>
#include <cmath>

namespace tern {

GridAxis::GridAxis(double low, double high, double step, double anchor) : step_(step), inverse_step_(1.0 / step) {
  lines_.push_back(low);
  for (double k = std::ceil((low - anchor) / step);; k += 1.0) {
    const double x = anchor + k * step;
    if (x > high - 0.25 * step) break;
    if (x >= low + 0.25 * step) lines_.push_back(x);
  }
  if (high > low) lines_.push_back(high);
  index();
}

void GridAxis::add(const std::vector<double>& lines) {
  const double lowest = low();
  const double highest = high();
  for (const double x : lines) {
    if (x > lowest && x < highest) lines_.push_back(x);
  }
  std::sort(lines_.begin(), lines_.end());
  lines_.erase(std::unique(lines_.begin(), lines_.end()), lines_.end());
  index();
}

void GridAxis::index() {
  const int buckets = static_cast<int>((high() - low()) / step_) + 1;
  bucket_.assign(static_cast<std::size_t>(buckets), 0);
  int i = 0;
  for (int k = 0; k < buckets; ++k) {
    while (i + 2 < size() && (*this)[i + 1] <= low() + k * step_) ++i;
    bucket_[idx(k)] = i;
  }
}

int GridAxis::cell(double x) const {
  if (!(x > low())) return 0;
  if (x >= high()) return std::max(0, size() - 2);
  const auto k = std::min(static_cast<std::size_t>((x - low()) * inverse_step_), bucket_.size() - 1);
  int i = bucket_[k];
  while (i > 0 && (*this)[i] > x) --i;
  while (i + 2 < size() && (*this)[i + 1] <= x) ++i;
  return i;
}

bool GridAxis::has_line_between(double a, double b) const {
  const auto next = std::upper_bound(lines_.begin(), lines_.end(), a);
  return next != lines_.end() && *next < b;
}

std::pair<int, int> GridAxis::lines_within(double a, double b) const {
  const auto first = std::lower_bound(lines_.begin(), lines_.end(), a);
  const auto last = std::upper_bound(first, lines_.end(), std::max(a, b));
  return {static_cast<int>(first - lines_.begin()), static_cast<int>(last - lines_.begin())};
}

}  // namespace tern
