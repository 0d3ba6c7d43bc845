// The door of tern-mission to a ground station, over MAVLink.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/world/vehicle.h"
#include "geodesy/local_frame.h"
#include "mavlink/link/link.h"
#include "mission/progress.h"
#include "mission/upload/mission_server.h"

namespace tern::mission {

/// Serves the mission protocol (MissionServer). Sends HEARTBEAT and MISSION_CURRENT at 1 Hz, and MISSION_ITEM_REACHED.
/// If the scenario has world.origin, it sends GLOBAL_POSITION_INT at 2 Hz.
class GroundStation {
 public:
  GroundStation(std::unique_ptr<mavlink::Link> link, std::uint8_t system, std::optional<LocalFrame> frame,
                MissionTaker taker);

  /// Receives and answers what has come, and sends what is due.
  /// @param progress, state  null: none yet
  void step(UTime now, const Progress* progress, const UavState* state);
  /// When step() is due next.
  [[nodiscard]] UTime next_wakeup() const { return next_look_; }
  void set_items(std::vector<mavlink::MissionItemInt> items) { server_.set_items(std::move(items)); }

 private:
  void send(const mavlink::Frame& frame);
  void report(UTime now, const Progress* progress, const UavState* state);

  std::unique_ptr<mavlink::Link> link_;
  mavlink::Parser parser_;
  MissionServer server_;
  std::optional<LocalFrame> frame_;
  UTime next_look_, next_report_, next_place_, began_;
  int reported_step_ = 0;
};

}  // namespace tern::mission
