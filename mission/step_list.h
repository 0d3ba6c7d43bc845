// Builds the steps of a mission: what a landing, a return and a hold are, whatever file they come from.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "geodesy/local_frame.h"
#include "mission/mission.h"

namespace tern::mission {

/// Where a mission is flown.
struct Site {
  std::optional<LocalFrame> frame;  ///< nullopt: places on the earth are refused
  std::string no_frame;             ///< why, if so
  Vec3 home = Vec3::Zero();         ///< uav.start: where the vehicle starts and returns to, W, m
  double landing_height = 1.0;      ///< the last goal of a landing is this far above the ground, m, > 0
};

/// Collects steps.
class StepList {
 public:
  explicit StepList(const Site& site) : site_(site) {}

  /// Fly past p within `radius`, m (0: the configured one), or stay there for hold_s > 0.
  void waypoint(const std::string& name, int item, const Vec3& p, double radius, double hold_s);
  void stop(const std::string& name, int item, const Vec3& p, double hold_s);
  /// Fly above the ground at the height of the step before, then down to landing_height above it.
  void land(int item, const Vec3& ground);
  /// Fly above home at the height of the step before, then to home.
  void go_home(int item);
  /// Stay beside a track for hold_s, at `offset` from its centre (W, m).
  void follow(const std::string& name, int item, std::int64_t track, const Vec3& offset, double hold_s);
  /// Steps that are added from now on are flown to at most this fast, m/s; 0: as fast as the vehicle can.
  void set_speed(double speed) { speed_ = speed; }
  /// Stay longer at the last step. @pre not empty()
  void stay_longer(double hold_s);

  [[nodiscard]] bool empty() const { return steps_.empty(); }
  /// The position of the last step, or home.
  [[nodiscard]] const Vec3& last() const;
  /// Returns the steps; the last one is never a Pass, since the vehicle ends at rest. An Error if there is none, or too
  /// many.
  [[nodiscard]] Result<std::vector<Step>> take();

 private:
  void descend(const std::string& name, int item, const Vec3& low);
  void add(Step step);

  const Site& site_;
  double speed_ = 0.0;
  std::vector<Step> steps_;
};

/// Returns why a step's numbers cannot be flown, as "hold of -1 s is out of range [0, 86400]"; "" if they can.
std::string why_no_step(const Vec3& position, double radius, double hold_s);

/// Returns why a speed (m/s) cannot be flown; "" if it can, and for 0.
std::string why_no_speed(double speed);

/// Returns whether a column or property of this name asks for a speed, but is not `speed`.
bool asks_for_other_speed(std::string_view name);
inline constexpr const char* kOtherSpeed =
    "is not known: state the largest speed on the way to a waypoint as `speed`, m/s";

inline constexpr double kMinSpeed = 0.1, kMaxSpeed = 100.0;  // m/s
inline constexpr double kMaxHoldS = 86'400.0;
inline constexpr double kMaxRadius = 1'000.0;
/// As of positions in a scenario, m.
inline constexpr double kMaxDistance = 1e5;

}  // namespace tern::mission
