// The measures of a flight that need no obstacle: limits, flight box, stops, path, arrival, exposure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/world/flight_result.h"
#include "core/world/vehicle.h"
#include "simulator/referee/flown_piece.h"

namespace tern {

inline constexpr double kGoalRadius = 0.2;      ///< arrival and first entry: within this distance of the goal, m
inline constexpr double kRestSpeed = 0.1;       ///< arrival and stops: under this speed, m/s
inline constexpr double kStopsCountFrom = 1.0;  ///< stops count after this world time, s
inline constexpr double kNearRegion = 1.0;      ///< "near" a region: within this distance of it, m
/// Accuracy of the times of first entry, arrival, stops and crossings of regions, s.
inline constexpr double kMeasureTimeResolution = 1e-5;

/// Return the first instant in [t0, t1] within kGoalRadius of the goal, and the first one there below kRestSpeed.
std::optional<double> first_entry(const FlownPiece& piece, double t0_s, double t1_s, const Vec3& goal);
std::optional<double> first_arrival(const FlownPiece& piece, double t0_s, double t1_s, const Vec3& goal);

/// Counts violations of the limits and of the flight box.
///
/// Per axis, speed, acceleration and jerk are compared with Limits·(1 + kLimitTolerance) at the true extrema of the
/// pieces. The body's bounding box is compared with the flight box. Jumps between consecutive pieces are compared with
/// kJoinTolerance: of position, of velocity, and of acceleration if the jerk is limited. A violation over consecutive
/// pieces counts once; a jump counts each time.
class LimitWatch {
 public:
  /// @param body_bounds the body's bounding box about its position, m.
  LimitWatch(const UavSpec& uav, const Box& body_bounds);

  void advance(const FlownPiece& piece, double t0_s, double t1_s);
  /// Takes a joint: the last piece ended with `before`, the next one begins with `now`.
  void join(const MotionSample& before, const MotionSample& now, double t_s);

  [[nodiscard]] std::int64_t violations() const { return violations_; }
  [[nodiscard]] const std::string& first() const { return first_; }  ///< text of the first violation; empty if none

 private:
  enum Kind { Speed, Acceleration, Jerk, FlightBox };
  static constexpr std::size_t kKinds = 4;
  void judge(Kind kind, const Vec3& value, const Vec3& limit, double t_s);
  void count(Kind kind, bool broken, const std::string& what);

  Limits limits_;
  Box centre_box_;  ///< where the position may be
  bool broken_[kKinds] = {};
  std::int64_t violations_ = 0;
  std::string first_;
};

/// Path length, top speed, jerk integral, stops and exposure, integrated over steps of at most some 10 ms.
class FlightMeasures {
 public:
  explicit FlightMeasures(const std::vector<Region>& regions);

  /// Takes the flight over [t0, t1]. @param arrives  it ends with arrival, so slowing down is not a stop
  void advance(const FlownPiece& piece, double t0_s, double t1_s, bool arrives);

  [[nodiscard]] double path_length_m() const { return path_length_m_; }
  [[nodiscard]] double top_speed_mps() const { return top_speed_mps_; }
  [[nodiscard]] double jerk_integral() const { return jerk_integral_; }  ///< ∫‖jerk‖² dt, m²/s⁵
  [[nodiscard]] std::int64_t stops() const { return stops_; }
  [[nodiscard]] const std::vector<Exposure>& exposure() const { return exposure_; }

 private:
  void count_stops(const FlownPiece& piece, double t0_s, double t1_s);
  void add_exposure(const FlownPiece& piece, double t0_s, double t1_s, double length_m);

  std::vector<Region> regions_;
  std::vector<Exposure> exposure_;
  double path_length_m_ = 0.0;
  double top_speed_mps_ = 0.0;
  double jerk_integral_ = 0.0;
  std::int64_t stops_ = 0;
  bool stopped_ = false;
};

}  // namespace tern
