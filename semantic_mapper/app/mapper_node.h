// The node of tern-mapper: publishes a map in chunks, again and again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/world/vehicle.h"
#include "core/world/voxel_map.h"
#include "runtime/bus.h"
#include "runtime/node.h"
#include "runtime/process.h"
#include "semantic_mapper/app/live_setup.h"

namespace tern {

/// A rotation of all chunks begins every second, or when the last rotation ends, whichever is later.
inline constexpr Duration kMapPeriod{1'000'000};
/// The largest rate of SEMANTIC_MAP, bytes/s.
inline constexpr std::int64_t kMapBytesPerSecond = 1'000'000;

class FenceUploads;
class LiveUpdates;

/// Publishes the chunks of a map in rotation. Chunks are at least kPacing apart, and their rate is at most
/// kMapBytesPerSecond. A small map is therefore complete once a second; a large one is repeated without pause.
/// HEARTBEAT says how long a rotation takes if it takes longer than kMapSilence, and repeats warnings on the map.
///
/// A live map changes by scans and OctoMaps (LiveMap). A changed map is published at once as a new version, once per
/// period at most. Each version is sent whole before the next one begins, so every receiver completes it.
///
/// With uploads of fences no map is published until FENCES has come. Other fences make a new version (FenceUploads).
class MapperNode final : public Node {
 public:
  /// @param live      nullopt: no scans change the map
  /// @param fenced    fenced_by_uploads()
  /// @param warnings  faults that may make the map wrong, for HEARTBEAT; may be empty
  /// @throws std::invalid_argument if the map needs more than kMaxMapChunks chunks, or is too large for a live map
  MapperNode(Bus& bus, const VoxelMap& map, const std::optional<LiveSetup>& live = {},
             const std::optional<Box>& fenced = {}, std::string warnings = "");
  ~MapperNode() override;

  [[nodiscard]] UTime next_wakeup() const override;
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;

 private:
  void publish(const VoxelMap& map);
  /// Publishes a map that has changed.
  void take_changes(UTime now);

  Bus& bus_;
  std::vector<MapChunk> chunks_;
  std::string rotation_text_, warnings_;  // for HEARTBEAT
  std::size_t at_ = 0;                    // index of the next chunk
  UTime rotation_began_;
  UTime next_;
  UTime earliest_;  // when the rate allows the next chunk
  std::unique_ptr<LiveUpdates> live_;
  std::unique_ptr<FenceUploads> fences_;
  VoxelMap unfenced_;  // the newest map without uploaded fences; empty if none are uploaded
};

/// Returns the flight box if fences are uploaded (mission.fence_uploads); nullopt if none are.
std::optional<Box> fenced_by_uploads(const Scenario& scenario, const MapperConfig& config);

/// Returns the node of tern-mapper: reads its section, loads the map and logs its content. @throws ConfigError
std::unique_ptr<Node> make_mapper_node(ProcessContext& context);

}  // namespace tern
