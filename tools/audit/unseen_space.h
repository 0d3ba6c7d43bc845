// The audit's own field of unseen movers, from the definition in docs/planner/unseen.md. It shares nothing with the
// planner's.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/world/sighting.h"

namespace tern::audit {

/// The movers that nobody has seen: upright, at most this fast, containing a square of this edge.
struct UnseenMover {
  double max_speed = 2.0;     ///< m/s
  double least_width = 0.4;   ///< m
  double clear_radius = 2.0;  ///< nobody is within this distance of the start at take-off, m
};

/// A lower bound of the distance from every place to every unseen mover, on cells in a window about the newest sensor.
/// Frames are used by the same rules as in the planner: at most one per sensor and 90 ms, level ones only.
class UnseenSpace {
 public:
  UnseenSpace(const UnseenMover& mover, const Eigen::Vector2d& start) : mover_(mover), start_(start) {}

  void add(const SightingSet& frame);
  /// Returns the bound at p at the time of the field, m. It is 0 where nothing is known.
  [[nodiscard]] double distance(const Eigen::Vector2d& p) const;
  /// Returns the time of the field; {0} before the first frame.
  [[nodiscard]] UTime at() const { return at_; }
  [[nodiscard]] std::int64_t frames() const { return frames_; }

 private:
  /// A cell by its place on an endless lattice.
  struct Cell {
    int x, y;
  };
  [[nodiscard]] std::size_t slot(Cell c) const;
  [[nodiscard]] Eigen::Vector2d centre(Cell c) const;
  void place_window(const Eigen::Vector2d& eye);
  [[nodiscard]] std::vector<bool> unseen_cells(const std::vector<double>& ranges, const Eigen::Vector2d& eye,
                                               double nearest, double age_s) const;
  void keep_where_movers_fit(std::vector<bool>& cells) const;
  void raise(const std::vector<bool>& cells);

  UnseenMover mover_;
  Eigen::Vector2d start_, origin_ = Eigen::Vector2d::Zero();
  UTime at_;
  std::int64_t frames_ = 0;
  Cell corner_{0, 0};
  std::vector<double> bound_;  ///< per cell of the window
  std::map<std::pair<std::int64_t, std::int32_t>, UTime> used_;
};

}  // namespace tern::audit
