// The door of tern-mission to a ground station, over MAVLink.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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

  /// Receives and answers what has come. An upload or an order may change the mission.
  void step(UTime now);
  /// Sends what is due of the state. @param progress, state  null: none yet
  void report(UTime now, const Progress* progress, const UavState* state);
  /// When step() is due next.
  [[nodiscard]] UTime next_wakeup() const { return next_look_; }
  /// Sets a mission that was not uploaded to this process: a download returns its steps. Empty: there is none.
  void set_mission(const std::vector<Step>& steps, const Site& site);
  /// Sets the mission that was uploaded: its items are known.
  void set_uploaded(const std::vector<Step>& steps);
  /// Sets the fences that a download returns.
  void set_fences(std::vector<mavlink::MissionItemInt> items) { server_.set_fences(std::move(items)); }
  /// Sends a text.
  void say(const std::string& text);

 private:
  void send(const mavlink::Frame& frame);

  std::unique_ptr<mavlink::Link> link_;
  mavlink::Parser parser_;
  MissionServer server_;
  std::optional<LocalFrame> frame_;
  UTime next_look_, next_report_, next_place_, began_;
  std::vector<std::uint16_t> seqs_;  // of the steps' items
  int reported_done_ = 0;            // steps
};

}  // namespace tern::mission
