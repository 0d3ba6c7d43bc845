// The message MAP_FILE: a map that another program made, as it arrives in flight.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.h"
#include "core/wire/header.h"

namespace tern {

/// The format of the bytes.
enum class MapFormat : std::int8_t {
  OctoMap = 0,  ///< of a .bt or an .ot file, header included
};

/// MAP_FILE: a file, or a part of one. Messages of one sender with the same `at` are the parts of one file.
struct MapFile {
  Header header;
  UTime at;  ///< when the sender received or made the file, vehicle's clock
  MapFormat format = MapFormat::OctoMap;
  Vec3 origin = Vec3::Zero();  ///< of the file's coordinates, W, m; their axes are those of W
  std::int32_t part = 0;       ///< number of this part
  std::int32_t parts = 1;      ///< how many there are
  std::vector<std::int8_t> bytes;
};
inline constexpr int kMaxMapFileBytesPerMessage = 59'000;
inline constexpr int kMaxMapFileParts = 1'000;

}  // namespace tern
