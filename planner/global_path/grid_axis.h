// One axis of a rectilinear grid. Its lines are evenly spaced at first; more are added where a gap needs one.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/types.h"

namespace tern {

/// The ascending coordinates of the lines, with a search in constant time.
class GridAxis {
 public:
  GridAxis() = default;
  /// Makes lines at low, at high, and between them at anchor + k·step, except nearer than step/4 to an end.
  /// @pre low ≤ high, step > 0
  GridAxis(double low, double high, double step, double anchor);

  /// Adds lines. Lines outside [low, high] are ignored; equal ones are added once.
  void add(const std::vector<double>& lines);

  [[nodiscard]] int size() const { return static_cast<int>(lines_.size()); }
  [[nodiscard]] double operator[](int i) const { return lines_[idx(i)]; }
  [[nodiscard]] double low() const { return lines_.front(); }
  [[nodiscard]] double high() const { return lines_.back(); }
  /// Returns the largest i ≤ size − 2 with line i ≤ x; 0 if x is below all lines, or if there is only one.
  [[nodiscard]] int cell(double x) const;
  /// Returns whether a line lies in the open interval (a, b).
  [[nodiscard]] bool has_line_between(double a, double b) const;
  /// Returns the index of the first line in the closed interval [a, b], and the index after the last one.
  [[nodiscard]] std::pair<int, int> lines_within(double a, double b) const;

 private:
  void index();

  double step_ = 1.0;
  double inverse_step_ = 1.0;
  std::vector<double> lines_;
  std::vector<std::int32_t> bucket_;  ///< bucket_[k]: cell of low + k·step
};

}  // namespace tern
