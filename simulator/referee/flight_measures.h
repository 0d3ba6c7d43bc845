// The measures of a flight that need no obstacle: limits, flight box, stops, path, arrival, exposure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/world/flight_result.h"
#include "core/world/scenario.h"
#include "core/world/vehicle.h"
#include "simulator/referee/flown_piece.h"

namespace tern {

inline constexpr double kGoalRadius = 0.2;      ///< reached and first entry: within this distance of the goal, m
inline constexpr double kRestSpeed = 0.1;       ///< reached and stopped: under this speed, m/s
inline constexpr double kStopsCountFrom = 1.0;  ///< stops count after this world time, s
inline constexpr double kNearRegion = 1.0;      ///< "near" a region: within this distance of it, m
/// First entry, arrival, stops and crossings of regions are found to this, s.
inline constexpr double kMeasureTimeResolution = 1e-5;

/// The first instant in [t0, t1] within kGoalRadius of the goal, and the first one there at under kRestSpeed.
std::optional<double> first_entry(const FlownPiece& piece, double t0_s, double t1_s, const Vec3& goal);
std::optional<double> first_arrival(const FlownPiece& piece, double t0_s, double t1_s, const Vec3& goal);

/// Counts how often limits or the flight box are left, and where first.
///
/// Compares speed, acceleration, jerk per axis with Limits·(1 + kLimitTolerance), at the true extrema of the pieces.
/// Compares the body's bounding box with the flight box, and jumps between consecutive pieces with kJoinTolerance: in
/// position, velocity, and acceleration where jerk is limited. A violation that lasts over consecutive pieces counts
/// once; a jump counts each time.
class LimitWatch {
 public:
  /// @param body_bounds the body's bounding box about its position, m.
  LimitWatch(const UavSpec& uav, const Box& body_bounds);

  void advance(const FlownPiece& piece, double t0_s, double t1_s);
  /// The next piece begins with `now`, the one before ended with `before`.
  void join(const MotionSample& before, const MotionSample& now, double t_s);

  [[nodiscard]] std::int64_t violations() const { return violations_; }
  [[nodiscard]] const std::string& first() const { return first_; }  ///< in words; empty if none

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

  /// Takes the flight over [t0, t1]; `arrives`: it ends with arrival, so that slowing down for it is no stop.
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
