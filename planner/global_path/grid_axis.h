// One axis of a rectilinear grid whose lines may lie unevenly: evenly at first, then one more wherever a gap needs it.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/types.h"

namespace tern {

/// Ascending coordinates with a constant-time search.
class GridAxis {
 public:
  GridAxis() = default;
  /// Lines at low, at high, and between them at anchor + k·step; none nearer than step/4 to an end.
  /// @pre low ≤ high, step > 0
  GridAxis(double low, double high, double step, double anchor);

  /// Adds lines (those outside [low, high] are ignored; equal ones are added once).
  void add(const std::vector<double>& lines);

  [[nodiscard]] int size() const { return static_cast<int>(lines_.size()); }
  [[nodiscard]] double operator[](int i) const { return lines_[idx(i)]; }
  [[nodiscard]] double low() const { return lines_.front(); }
  [[nodiscard]] double high() const { return lines_.back(); }
  /// The largest i ≤ size − 2 with line i ≤ x; 0 when x lies below. (0 for an axis of one line.)
  [[nodiscard]] int cell(double x) const;
  /// Is there a line in the open interval (a, b)?
  [[nodiscard]] bool has_line_between(double a, double b) const;
  /// The lines in the closed interval [a, b]: the first one, and the one after the last.
  [[nodiscard]] std::pair<int, int> lines_within(double a, double b) const;

 private:
  void index();

  double step_ = 1.0;
  double inverse_step_ = 1.0;
  std::vector<double> lines_;
  std::vector<std::int32_t> bucket_;  ///< bucket_[k]: cell of low + k·step
};

}  // namespace tern
