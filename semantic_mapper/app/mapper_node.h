// The node of tern-mapper: publishes a map in chunks, again and again.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/world/voxel_map.h"
#include "runtime/bus.h"
#include "runtime/node.h"
#include "runtime/process.h"

namespace tern {

/// A rotation of all chunks begins every second, or when the last rotation ends, whichever is later.
inline constexpr Duration kMapPeriod{1'000'000};
/// The largest rate of SEMANTIC_MAP, bytes/s.
inline constexpr std::int64_t kMapBytesPerSecond = 1'000'000;

/// Publishes the chunks of a map in rotation. Chunks are at least kPacing apart, and their rate is at most
/// kMapBytesPerSecond. A small map is therefore complete once a second; a large one is repeated without pause.
class MapperNode final : public Node {
 public:
  /// @throws std::invalid_argument if the map needs more than kMaxMapChunks chunks
  MapperNode(Bus& bus, const VoxelMap& map);

  [[nodiscard]] UTime next_wakeup() const override { return next_; }
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override { return {ProcessState::Ready, ""}; }

 private:
  Bus& bus_;
  std::vector<MapChunk> chunks_;
  std::size_t at_ = 0;  // index of the next chunk
  UTime rotation_began_;
  UTime next_;
};

/// Returns the node of tern-mapper: reads its section, loads the map and logs its content. @throws ConfigError
std::unique_ptr<Node> make_mapper_node(ProcessContext& context);

}  // namespace tern
