// The fences that a ground station has uploaded: publishes them, and watches that the map holds them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/time.h"
#include "core/scenario/scenario.h"
#include "core/world/voxel_map.h"
#include "mission/app/mission_record.h"
#include "mission/mission.h"
#include "mission/upload/mission_server.h"
#include "runtime/bus.h"

namespace tern::mission {

/// Publishes FENCES. Fences are in force once SEMANTIC_MAP has held all that they forbid for kMapSilence. Then every
/// receiver of the map has it, even if it lost a chunk. A mission must not be started before.
///
/// | event                                       | fences that are published | a mission may be started            |
/// |---------------------------------------------|---------------------------|-------------------------------------|
/// | an upload begins                            | those before              | not until an upload is accepted     |
/// | it is refused, or breaks off                | those before              | not until an upload is accepted     |
/// | it is accepted, or fences are cleared       | the new ones              | once they are in force              |
/// | a restart                                   | those of the record       | once they are in force              |
/// | a restart with a record that is unreadable  | none                      | not until an upload is accepted     |
class FenceKeeper {
 public:
  FenceKeeper(Bus& bus, const MissionRecord& record, Site site, UavSpec uav);

  /// An upload begins.
  void await() { refused_ = "the last upload of fences has not ended"; }
  /// Takes an upload. Without items there are no fences from then on.
  /// @param map  SEMANTIC_MAP as it is now
  /// @param mission  the mission that is there; null: none
  /// @param vehicle  where it is, W, m
  /// @return "" or why it is refused:
  ///   - an item (fences_of), or a polygon that crosses itself;
  ///   - a map that ends within the fences (uploaded_fence_labels);
  ///   - a step of the mission, or the vehicle, beyond them;
  ///   - they cannot be recorded
  std::string take(const std::vector<mavlink::MissionItemInt>& items, const VoxelMap& map, const Mission* mission,
                   const Vec3& vehicle);
  /// Notes why an upload is refused, and returns it.
  std::string refuse(std::string why);
  /// A new version of SEMANTIC_MAP has come.
  void receive(const VoxelMap& map);
  /// Publishes FENCES if it is due. @return texts for the ground station
  std::vector<std::string> step(UTime now);
  [[nodiscard]] UTime next_wakeup() const { return next_publish_; }

  /// Why no mission may be started yet; "" if the fences are in force.
  [[nodiscard]] std::string not_in_force() const;
  /// Which steps, or whether the vehicle, are beyond the fences; "" if none is.
  [[nodiscard]] std::string why_beyond(const Mission* mission, const Vec3& vehicle) const;
  /// The items of the fences, as they were uploaded.
  [[nodiscard]] const std::vector<mavlink::MissionItemInt>& items() const { return items_; }

 private:
  Result<VoxelMap> forbidden(const std::vector<Fence>& fences, const VoxelGrid& grid) const;
  [[nodiscard]] std::string beyond(const VoxelMap& map, const Mission* mission, const Vec3& vehicle) const;

  Bus& bus_;
  const MissionRecord& record_;
  Site site_;
  UavSpec uav_;
  std::vector<mavlink::MissionItemInt> items_;
  std::vector<Fence> fences_;
  std::optional<VoxelMap> forbidden_;  ///< occupied where the fences forbid; nullopt: no fences, or no map yet
  std::string refused_;                ///< why the last upload was refused; "": it was accepted
  bool is_readable_ = true;            ///< false: fences were recorded, but which?
  std::optional<UTime> held_since_;    ///< SEMANTIC_MAP has held the fences since
  bool is_in_force_ = false, has_complained_ = false;
  UTime next_publish_, changed_;
};

/// FENCES is repeated after this time.
inline constexpr Duration kFencePeriod{1'000'000};
/// After this time without effect the ground station is told so.
inline constexpr Duration kFencePatience{10'000'000};

}  // namespace tern::mission
