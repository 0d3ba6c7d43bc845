// tern-mapper: a map, published for ever in chunks.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/world/voxel_map.h"
#include "runtime/bus.h"
#include "runtime/node.h"
#include "runtime/process.h"

namespace tern {

/// A rotation begins every second, or when the one before is done.
inline constexpr Duration kMapPeriod{1'000'000};
/// SEMANTIC_MAP takes no more than this of the network, bytes/s.
inline constexpr std::int64_t kMapBytesPerSecond = 1'000'000;

/// Publishes the chunks of a map in rotation: one at a time, at least kPacing apart and kMapBytesPerSecond on average.
/// So a small map is whole once a second, and a large one repeats without a pause.
class MapperNode final : public Node {
 public:
  /// @throws std::invalid_argument when the map takes more than kMaxMapChunks.
  MapperNode(Bus& bus, const VoxelMap& map);

  [[nodiscard]] UTime next_wakeup() const override { return next_; }
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override { return {ProcessState::Ready, ""}; }

 private:
  Bus& bus_;
  std::vector<MapChunk> chunks_;
  std::size_t at_ = 0;  // the next chunk
  UTime rotation_began_;
  UTime next_;
};

/// The node of a process: reads the section, loads the map, says what is in it. @throws ConfigError.
std::unique_ptr<Node> make_mapper_node(ProcessContext& context);

}  // namespace tern
