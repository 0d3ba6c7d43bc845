// tern-mavlink: a bridge on the bus.
#pragma once

#include <memory>
#include <optional>

#include "core/world/goal.h"
#include "core/world/scenario.h"
#include "mavlink/bridge.h"
#include "mavlink/link/link.h"
#include "runtime/bus.h"
#include "runtime/node.h"

namespace tern::mavlink {

/// Hears SETPOINT, HORIZON_REQUEST, GOAL, FLIGHT_RESULT; says UAV_STATE and VEHICLE_STATUS, and VEHICLE_TRUTH where the
/// autopilot tells it. A GOAL of mode Go with a larger id than the first one heard tells the bridge to fly (again);
/// FLIGHT_RESULT to land. With start arm it arms by itself only as long as no GOAL was heard: a bridge that is started
/// anew in or after a flight waits. While another process says VEHICLE_STATUS it says nothing, to nobody: of two
/// bridges one flies.
///
/// When it ends while it flies, it has the autopilot land, and waits kLandPatience for it to do so.
class MavlinkNode final : public Node {
 public:
  static constexpr Duration kLandPatience{30'000'000};
  MavlinkNode(Bus& bus, std::unique_ptr<Link> link, const UavSpec& uav, const BridgeConfig& config,
              std::optional<SigningKey> key);
  ~MavlinkNode() override;

  [[nodiscard]] UTime next_wakeup() const override { return next_; }
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;

 private:
  void on_goal(const Goal& goal);
  void on_status(const VehicleStatus& status);
  void exchange(UTime now);
  void publish(UTime now);
  void log_lines();
  [[nodiscard]] bool alone(UTime now) const;

  Bus& bus_;
  std::unique_ptr<Link> link_;
  std::optional<SigningKey> key_;
  Parser parser_;
  Bridge bridge_;
  UTime begun_, next_, next_status_;
  UTime received_;  ///< when the newest bytes came, at most now
  std::optional<UTime> other_received_;
  std::optional<std::int64_t> goal_id_;
  UTime published_state_, published_truth_;
  bool followed_ = false;
  std::uint64_t signature_time_ = 0;
};

}  // namespace tern::mavlink
