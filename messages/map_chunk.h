// SEMANTIC_MAP on the wire: lcmtypes/map_chunk_t.lcm.
#pragma once

#include "core/world/voxel_map.h"
#include "messages/codec.h"

namespace tern {

template <>
Bytes encode(const MapChunk& value);
/// Inconsistent: runs that end beyond the grid, a class that has no name, a first class name that is not empty.
template <>
tl::expected<MapChunk, Rejection> decode(std::span<const std::uint8_t> bytes);

}  // namespace tern
