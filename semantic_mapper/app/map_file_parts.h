// Joins the parts of a MAP_FILE.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/world/map_file.h"

namespace tern {

/// Collects the parts of one file at a time. A part of another file takes the place of an incomplete one. Senders
/// repeat their files; one that was complete is not given again. Memory: that of one file, at most
/// kMaxMapFileParts · kMaxMapFileBytesPerMessage.
class MapFileParts {
 public:
  /// @return the bytes of the file, if this part completes it
  std::optional<std::vector<std::uint8_t>> add(const MapFile& part);

 private:
  std::int64_t sender_ = 0;  ///< epoch
  UTime at_;
  Vec3 origin_ = Vec3::Zero();
  std::vector<std::optional<std::vector<std::int8_t>>> parts_;
  std::size_t missing_ = 0;  ///< parts that have not come; 0: none is awaited
};

}  // namespace tern
