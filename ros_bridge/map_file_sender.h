// Sends a file for the map in parts, again and again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/time.h"
#include "core/world/map_file.h"

namespace tern::ros {

/// The largest rate of MAP_FILE, bytes/s, as that of SEMANTIC_MAP.
inline constexpr std::int64_t kMapFileBytesPerSecond = 1'000'000;
/// A file is repeated at this interval, or when its parts are through, whichever is later.
inline constexpr Duration kMapFilePeriod{5'000'000};

/// Holds the newest file. One that is being sent is finished first, so receivers complete every file that they begin.
class MapFileSender {
 public:
  /// @param parts  of one file, in order; ≥ 1
  void set(std::vector<MapFile> parts) { newest_ = std::move(parts); }
  /// Returns the part that is due; nullptr: none is. Call it until then.
  const MapFile* due(UTime now);

 private:
  std::vector<MapFile> sent_;
  std::optional<std::vector<MapFile>> newest_;  ///< nullopt: it is the one that is sent
  std::size_t at_ = 0;                          ///< index of the next part
  UTime began_, next_;
  UTime earliest_;  ///< when the rate allows the next part
};

}  // namespace tern::ros
