// tern-mission: flies a mission by goals.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/world/voxel_map.h"
#include "mission/app/fence_keeper.h"
#include "mission/app/ground_station.h"
#include "mission/app/mission_config.h"
#include "mission/app/mission_record.h"
#include "mission/progress.h"
#include "runtime/batches.h"
#include "runtime/bus.h"
#include "runtime/node.h"

namespace tern::mission {

inline constexpr int kExitCannotFly = 2;  ///< a step lies in an obstacle of the map or beyond a fence

/// The inputs of a MissionNode.
struct MissionSetup {
  std::optional<Mission> mission;  ///< of a file; nullopt: a ground station uploads one
  Site site;
  UavSpec uav;
  ProgressConfig config;
  std::string folder;                   ///< for the record; "": none is written
  std::unique_ptr<mavlink::Link> link;  ///< to a ground station; null: none
  std::uint8_t system = 1;              ///< MAVLink's id of the vehicle
  bool fence_uploads = false;           ///< fences are uploaded as well, and the mapper waits for them
  bool start_on_upload = false;         ///< an uploaded mission needs no order to start
};

/// Connects Progress to the bus. Receives UAV_STATE, VEHICLE_STATUS, GOAL, SEMANTIC_MAP and PREDICTIONS; publishes
/// GOAL and SPEED_LIMIT, and with fence_uploads FENCES (FenceKeeper).
///
/// 1. It waits for a map, and refuses steps in occupied voxels. A file's mission then ends the process with
///    kExitCannotFly, before any goal is sent. An upload is refused, and one from before a restart is forgotten.
/// 2. It listens for kListen. The vehicle repeats its goal at 1 Hz, so after a restart the mission continues there.
/// 3. Without a mission it sends a goal to hold, until one is uploaded and started.
/// 4. It sends goals until the mission is done or has failed. HEARTBEAT then says Finished or Failed, and the last goal
///    is repeated until the process is ended.
///
/// With start_on_upload an uploaded mission starts without an order, kUploadPause after the last upload: fences are
/// uploaded after it. If they do not allow it yet, it starts later.
///
/// Fences are not changed while a mission is flown, and no mission begins before they are in force.
///
/// A restarted process flies an uploaded mission only if it was started, or with start_on_upload, and none that has
/// ended.
class MissionNode final : public Node {
 public:
  MissionNode(Bus& bus, MissionSetup setup);

  [[nodiscard]] UTime next_wakeup() const override;
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;
  [[nodiscard]] std::optional<int> finished() const override { return exit_code_; }

 private:
  void on_map(const MapChunk& chunk);
  void on_goal(const Goal& goal);
  void on_predictions(const TrackSet& batch);
  void on_state(const UavState& state);
  /// Sets the mission to be flown. It waits for start().
  void set_mission(Mission mission);
  [[nodiscard]] std::string take_upload(const std::vector<Item>& items);
  [[nodiscard]] std::string take_fences(const std::vector<mavlink::MissionItemInt>& items);
  [[nodiscard]] std::string obey(Order order);
  /// Why no mission may begin; "" if one may.
  [[nodiscard]] std::string why_no_start() const;
  [[nodiscard]] bool is_flown() const;
  [[nodiscard]] const Vec3& place() const { return state_ ? state_->motion.p : setup_.site.home; }
  void forget_mission();
  /// Which steps are in obstacles; "" if none is.
  [[nodiscard]] std::string why_blocked(const Mission& mission, bool is_uploaded) const;
  /// Judges the steps by the first map.
  void judge_steps();
  void begin(UTime now);
  void start_itself(UTime now);
  void start(UTime now);
  void hold(UTime now);
  void note();

  Bus& bus_;
  MissionSetup setup_;
  std::optional<Progress> progress_;  ///< of the mission; nullopt: none is there
  MissionRecord record_;
  std::unique_ptr<FenceKeeper> fences_;  ///< null: without fence_uploads
  std::unique_ptr<GroundStation> station_;
  MapAssembler assembler_;
  std::optional<VoxelMap> map_;  ///< the first one; with fence_uploads the newest before a mission begins
  BatchCollector<TrackSet> batches_;
  std::optional<UavState> state_;
  bool following_ = false;
  bool is_ordered_ = false;   ///< to fly: by a file, or by the ground station
  bool is_uploaded_ = false;  ///< the mission is not a file's
  bool has_started_ = false;
  std::optional<Goal> heard_;  ///< the goal with the largest id, before the start
  std::optional<Goal> hold_;   ///< the goal while there is no mission
  UTime listens_until_, next_hold_;
  UTime starts_itself_at_ = kNever;
  std::string no_start_;   ///< why it did not start itself, as last said
  bool is_fresh_ = false;  ///< uploaded to this process: an older record is not its own
  std::optional<int> exit_code_;
  std::string noted_;  ///< the state that was recorded last
  bool has_failed_to_write_ = false;
};

/// The vehicle repeats its goal every second.
inline constexpr Duration kListen{1'500'000};
/// From the last upload to a start without an order.
inline constexpr Duration kUploadPause{3'000'000};

}  // namespace tern::mission
