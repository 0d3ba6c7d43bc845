// tern-mavlink: the bridge as a process.
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

/// Connects a Bridge to the bus. Receives SETPOINT, HORIZON_REQUEST, PLAN, GOAL and FLIGHT_RESULT; publishes UAV_STATE,
/// VEHICLE_STATUS, and VEHICLE_TRUTH if the autopilot reports it.
///
/// - A GOAL of mode Go with a larger id than the first one orders the bridge to fly (again).
/// - FLIGHT_RESULT makes it land.
/// - `start: arm` arms only before the first GOAL: a bridge that is restarted during or after a flight waits.
/// - While another process publishes VEHICLE_STATUS, it publishes and sends nothing: one of two bridges flies.
/// - If it ends while it flies, it has the autopilot land, and waits up to kLandPatience for that.
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
  UTime received_;  ///< receive time of the newest bytes, at most now
  std::optional<UTime> other_received_;
  std::optional<std::int64_t> goal_id_;
  UTime published_state_, published_truth_;
  bool followed_ = false;
  std::uint64_t signature_time_ = 0;
};

}  // namespace tern::mavlink
