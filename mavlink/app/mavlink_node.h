// tern-mavlink: the bridge as a process.
#pragma once

#include <memory>
#include <optional>

#include "core/scenario/scenario.h"
#include "core/world/goal.h"
#include "mavlink/bridge.h"
#include "mavlink/link/link.h"
#include "runtime/bus.h"
#include "runtime/node.h"

namespace tern::mavlink {

/// Connects a Bridge to the bus. Receives SETPOINT, HORIZON_REQUEST, PLAN, GOAL and FLIGHT_RESULT; publishes UAV_STATE,
/// VEHICLE_STATUS, and VEHICLE_TRUTH if the autopilot reports it. With `odometry` it publishes ODOMETRY.
///
/// - A GOAL of mode Go with a larger id than all before orders the bridge to fly (again).
/// - The first GOAL of mode Go orders nothing if its id, as a time in µs, is before the start of this process. It may
///   have been sent to an earlier process. So the flight is under way or over, and `start: arm` arms no longer.
/// - FLIGHT_RESULT makes it land.
/// - While another process publishes VEHICLE_STATUS, this one publishes and sends nothing: only one of two bridges
///   flies.
/// - A tern-executor in state Failed has given the vehicle up: the autopilot lands it, and no GOAL orders a flight.
/// - Asked to end, it has the autopilot land what it flies, and goes on until the vehicle is disarmed. So a pilot who
///   flies keeps the external vision. It gives up when the link is silent for kLinkPatience, or when it is asked
///   again after kSameSignal. It then says that the vehicle is armed, and ends with kExitArmed.
/// - Before it ends it sets back the parameters that it has set. It waits up to kSetBackPatience for that.
/// - If an error ends it while it flies, it has the autopilot land, and waits up to kLandPatience for that.
class MavlinkNode final : public Node {
 public:
  static constexpr Duration kLandPatience{30'000'000}, kLinkPatience{10'000'000}, kSameSignal{1'000'000},
      kSetBackPatience{3'000'000};
  static constexpr int kExitArmed = 5;  ///< docs/reference/exit_codes.md
  MavlinkNode(Bus& bus, std::unique_ptr<Link> link, const UavSpec& uav, const BridgeConfig& config,
              std::optional<SigningKey> key, std::unique_ptr<Link> estimator = nullptr);
  ~MavlinkNode() override;

  [[nodiscard]] UTime next_wakeup() const override { return next_; }
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;
  [[nodiscard]] bool end(UTime now) override;
  [[nodiscard]] std::optional<int> finished() const override { return exit_code_; }

 private:
  void on_goal(const Goal& goal);
  void on_status(const VehicleStatus& status);
  void on_heartbeat(const tern::Heartbeat& heartbeat);
  /// Whether the vehicle needs this bridge: it flies, or the vehicle is armed.
  [[nodiscard]] bool is_needed() const { return bridge_.flies() || bridge_.autopilot().armed(); }
  void finish_if_disarmed(UTime now);
  void finish(int code);
  void end_armed(const std::string& why);
  void exchange(UTime now);
  void exchange_with_estimator(UTime now);
  void publish(UTime now);
  void publish_estimate();
  void land();
  void log_lines();
  [[nodiscard]] bool alone(UTime now) const;

  Bus& bus_;
  std::unique_ptr<Link> link_;
  std::unique_ptr<Link> estimator_;  ///< of a companion; may be null
  std::optional<SigningKey> key_;
  Parser parser_, estimator_parser_;
  Bridge bridge_;
  UTime begun_, next_, next_status_;
  UTime received_;  ///< receive time of the newest bytes, at most now
  std::optional<UTime> other_received_;
  std::optional<UTime> asked_to_end_, disarmed_since_;
  UTime next_report_;  ///< while it is asked to end
  std::optional<int> exit_code_;
  std::optional<std::int64_t> goal_id_;  ///< the largest received
  bool executor_gave_up_ = false;
  UTime published_state_, published_truth_;
  std::optional<tern::Odometry> published_estimate_;
  bool followed_ = false;
  std::optional<UTime> stood_back_;  ///< since when the bridge stands back; nullopt: it does not
  std::uint64_t signature_time_ = 0;
};

}  // namespace tern::mavlink
