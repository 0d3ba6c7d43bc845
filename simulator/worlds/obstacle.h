// One true obstacle of a world: an axis-aligned box and where it is at each instant.
#pragma once

#include <cstdint>

#include "core/base/result.h"
#include "core/base/time.h"
#include "core/base/types.h"
#include "core/world/scenario.h"

namespace tern {

/// Where nothing is declared, the sensor sees the world on its way for so long before world time 0. A vehicle looks
/// around before it takes off, and learns how fast things are.
inline constexpr Duration kLookAroundTime{1'500'000};

/// Where an obstacle's centre is and how fast it goes, W.
struct ObstacleState {
  Vec3 p = Vec3::Zero();  ///< m
  Vec3 v = Vec3::Zero();  ///< m/s; at a corner the later one
};

/// Bounds per axis that hold at every time; corners (jumps of velocity) excepted, see WorldObstacle::next_corner.
struct ObstacleBounds {
  Vec3 speed = Vec3::Zero();         ///< max |v|, m/s
  Vec3 acceleration = Vec3::Zero();  ///< max |a| between corners, m/s²
  Vec3 fourth = Vec3::Zero();        ///< max |p⁗| between corners, m/s⁴
};

/// An obstacle of the world: the spec of its motion, checked, with times rounded to whole µs (the world's clock).
///
/// Time t is world time in seconds. Before t = 0 the world rests where it is at t = 0. Only the sensor of a world that
/// is not declared sees it on its way there (kLookAroundTime, begins_s). For w = t/s and c, k, φ of the spec:
///   trefoil  c + (k_x (sin(w+φ) + 2 sin(2w+φ)), k_y (cos(w+φ) − 2 cos(2w+φ)), −k_z sin(3w+φ)), so that
///            |v| ≤ (5, 5, 3)·k/s, |a| ≤ (9, 9, 9)·k/s², |p⁗| ≤ (33, 33, 81)·k/s⁴ per axis;
///   wave     c + A sin(w+φ): |v| ≤ |A|/s, |a| ≤ |A|/s², |p⁗| ≤ |A|/s⁴;
///   linear, waypoints: straight between corners, a = 0. Waypoints do not use c: here c is the first one.
/// An obstacle whose waypoint motion vanishes is absent outside [first_s, last_s]; all others are always present.
class WorldObstacle {
 public:
  /// Largest |coordinate|, |half-extent|, |scale| of a world, m; times reach this many seconds.
  static constexpr double kMaxCoordinate = 1e5;

  /// @return an Error that names field, value and limit. It says that a number is not finite or out of range, waypoint
  /// times do not ascend by ≥ 1 µs, or the obstacle never exists. Or a repeating motion does not end where it began or
  /// lasts no time.
  static Result<WorldObstacle> make(std::int64_t id, ObstacleSpec spec);

  [[nodiscard]] std::int64_t id() const { return id_; }  ///< ≥ 0: its place in World::obstacles
  [[nodiscard]] const ObstacleSpec& spec() const { return spec_; }
  [[nodiscard]] const Vec3& half_extents() const { return spec_.half_extents; }
  [[nodiscard]] bool moves() const { return moves_; }
  [[nodiscard]] const ObstacleBounds& bounds() const { return bounds_; }

  [[nodiscard]] double first_s() const { return first_s_; }  ///< present from here on (−∞ where it always was)
  [[nodiscard]] double last_s() const { return last_s_; }    ///< present until here (∞ where it always will be)
  [[nodiscard]] bool present(double t_s) const { return t_s >= first_s_ && t_s <= last_s_; }
  /// When its motion begins; −∞ where it always moved, or never does.
  [[nodiscard]] double begins_s() const;
  /// From now on it never was and never will be there: present from a time that no flight reaches to one before all.
  void leave_out() {
    first_s_ = 1e9;
    last_s_ = -1e9;
  }

  /// Position and velocity at t_s; while absent: where it appears next or was last, at rest. O(1), O(log n) for
  /// waypoints.
  [[nodiscard]] ObstacleState at(double t_s) const;
  /// The first time after t_s at which the velocity jumps; ∞ where there is none.
  [[nodiscard]] double next_corner(double t_s) const;
  /// The true box at t_s, W.
  [[nodiscard]] Box box(double t_s) const { return box_around(at(t_s).p, spec_.half_extents); }

 private:
  WorldObstacle() = default;

  std::int64_t id_ = 0;
  ObstacleSpec spec_;
  ObstacleBounds bounds_;
  bool moves_ = false;
  double first_s_ = 0.0;
  double last_s_ = 0.0;
};

/// The state of a motion at t_s (the formulas above, before t = 0 as well), whatever the presence. @pre the spec passed
/// WorldObstacle::make.
ObstacleState motion_state(const ObstacleSpec& spec, double t_s);

/// Distance from point p to the box of centre c and half-extents h, m; 0 inside.
double distance_to_box(const Vec3& p, const Vec3& c, const Vec3& h);

/// t rounded to whole µs, s.
double whole_microseconds(double t_s);

}  // namespace tern
