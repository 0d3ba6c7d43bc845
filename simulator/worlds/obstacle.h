// One true obstacle of a world: an axis-aligned box and where it is at each instant.
#pragma once

#include <cstdint>

#include "core/base/result.h"
#include "core/base/time.h"
#include "core/base/types.h"
#include "core/scenario/scenario.h"

namespace tern {

/// Without declared motions, the sensor sees the world move for this long before world time 0. So the predictor learns
/// how fast things are before take-off.
inline constexpr Duration kLookAroundTime{1'500'000};

/// Position and velocity of an obstacle's centre, W.
struct ObstacleState {
  Vec3 p = Vec3::Zero();  ///< m
  Vec3 v = Vec3::Zero();  ///< m/s; at a corner, the velocity after it
};

/// Bounds per axis at all times except corners, where the velocity jumps (WorldObstacle::next_corner).
struct ObstacleBounds {
  Vec3 speed = Vec3::Zero();         ///< max |v|, m/s
  Vec3 acceleration = Vec3::Zero();  ///< max |a| between corners, m/s²
  Vec3 fourth = Vec3::Zero();        ///< max |p⁗| between corners, m/s⁴
};

/// An obstacle of the world: a checked spec of its motion, with times rounded to whole µs (the world's clock).
///
/// Time t is world time in seconds, w = t/s, and c, k, s, φ, A are those of the spec:
///
/// | motion            | centre                                                                             |
/// |-------------------|------------------------------------------------------------------------------------|
/// | trefoil           | c + (k_x (sin(w+φ) + 2 sin(2w+φ)), k_y (cos(w+φ) − 2 cos(2w+φ)), −k_z sin(3w+φ))    |
/// | wave              | c + A sin(w+φ)                                                                     |
/// | linear, waypoints | straight between corners; for waypoints c is the first one                         |
///
/// | motion  | bounds per axis                                                    |
/// |---------|--------------------------------------------------------------------|
/// | trefoil | abs v ≤ (5, 5, 3)·k/s, abs a ≤ (9, 9, 9)·k/s², abs p⁗ ≤ (33, 33, 81)·k/s⁴ |
/// | wave    | abs v ≤ A/s, abs a ≤ A/s², abs p⁗ ≤ A/s⁴                           |
/// | others  | a = 0                                                              |
///
/// Before t = 0 the world rests where it is at t = 0. Only the sensor of an undeclared world sees it move towards there
/// (kLookAroundTime, begins_s). An obstacle with vanishing waypoints is absent outside [first_s, last_s]; all others
/// are always present.
class WorldObstacle {
 public:
  /// Largest absolute coordinate, half-extent and scale of a world, m; also the largest time, s.
  static constexpr double kMaxCoordinate = 1e5;

  /// Checks the spec. @return an Error with field, value and limit, if
  /// - a number is not finite or out of range,
  /// - waypoint times do not ascend by at least 1 µs,
  /// - the obstacle never exists, or
  /// - a repeating motion ends elsewhere than it began, or has no duration.
  static Result<WorldObstacle> make(std::int64_t id, ObstacleSpec spec);

  [[nodiscard]] std::int64_t id() const { return id_; }  ///< ≥ 0: its index in World::obstacles
  [[nodiscard]] const ObstacleSpec& spec() const { return spec_; }
  [[nodiscard]] const Vec3& half_extents() const { return spec_.half_extents; }
  [[nodiscard]] bool moves() const { return moves_; }
  [[nodiscard]] const ObstacleBounds& bounds() const { return bounds_; }

  [[nodiscard]] double first_s() const { return first_s_; }  ///< present from here on; −∞ if always
  [[nodiscard]] double last_s() const { return last_s_; }    ///< present until here; ∞ if always
  [[nodiscard]] bool present(double t_s) const { return t_s >= first_s_ && t_s <= last_s_; }
  /// When its motion begins; −∞ if it always or never moves.
  [[nodiscard]] double begins_s() const;
  /// Makes the obstacle absent at all times, by a presence that ends before it begins.
  void leave_out() {
    first_s_ = 1e9;
    last_s_ = -1e9;
  }

  /// Position and velocity at t_s. While absent, it is at rest where it appears next or was last. O(1); O(log n) for
  /// waypoints.
  [[nodiscard]] ObstacleState at(double t_s) const;
  /// The first time after t_s at which the velocity jumps; ∞ if there is none.
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

/// The state of a motion at t_s by the formulas above, also before t = 0, regardless of presence.
/// @pre the spec passed WorldObstacle::make
ObstacleState motion_state(const ObstacleSpec& spec, double t_s);

/// Distance from point p to the box of centre c and half-extents h, m; 0 inside.
double distance_to_box(const Vec3& p, const Vec3& c, const Vec3& h);

/// Rounds t to whole µs, s.
double whole_microseconds(double t_s);

}  // namespace tern
