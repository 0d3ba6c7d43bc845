// How much of a map has arrived, and how long its chunks take on the bus.
#pragma once

#include <string>
#include <vector>

#include "core/base/time.h"
#include "core/world/voxel_map.h"

namespace tern {

/// The longest time that a chunk of SEMANTIC_MAP takes on the bus: 60 kB at the mapper's 1 MB/s.
inline constexpr Duration kMapChunkTime{60'000};

/// Counts the chunks of the newest version of a map. MapAssembler joins them.
class MapProgress {
 public:
  void add(const MapChunk& chunk);
  /// All chunks of the newest version have arrived.
  [[nodiscard]] bool is_complete() const { return !have_.empty() && chunks_ == static_cast<int>(have_.size()); }
  /// The longest time that a rotation of all chunks takes; 0 before the first chunk.
  [[nodiscard]] Duration rotation() const { return kMapChunkTime * static_cast<std::int64_t>(have_.size()); }
  /// Returns "a semantic map", and of one that takes longer than kMapSilence "a semantic map (212 of 500 chunks, all
  /// take up to 30 s)".
  [[nodiscard]] std::string missing() const;

 private:
  std::uint64_t version_ = 0;
  std::vector<bool> have_;
  int chunks_ = 0;
};

}  // namespace tern
