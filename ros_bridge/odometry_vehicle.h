// A vehicle that reports itself by odometry: UAV_STATE and VEHICLE_STATUS.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <utility>

#include "core/base/result.h"
#include "core/world/vehicle.h"
#include "core/world/vehicle_status.h"
#include "ros_bridge/intake.h"

namespace tern::ros {

/// Turns odometry into states. Odometry has no acceleration. The acceleration of a state is the slope of the velocities
/// of the last kSlope, by least squares, and 0 until there are three.
///
/// ROS has no message that says whether a vehicle follows its setpoints. Here it follows while its odometry is at most
/// kOldestOdometry old. With `asks`, /following must also have said true within kOldestWord.
class OdometryVehicle {
 public:
  static constexpr Duration kSlope{100'000}, kOldestWord{1'000'000};

  /// @param mode  of VEHICLE_STATUS
  explicit OdometryVehicle(bool asks, std::string mode = "ROS 2") : asks_(asks), mode_(std::move(mode)) {}
  /// @return an Error if the reading is not newer than the one before
  Result<UavState> receive(const OdometryReading& reading);
  /// Takes what /following says.
  void receive_following(bool following, UTime now);
  [[nodiscard]] VehicleStatus status(UTime now) const;
  [[nodiscard]] std::optional<Vec3> position() const;

 private:
  bool asks_;
  std::string mode_;
  std::deque<OdometryReading> readings_;  ///< of the last kSlope, the newest last
  std::optional<UTime> told_;             ///< when /following last said true
  std::int64_t resets_ = 0;
};

}  // namespace tern::ros
