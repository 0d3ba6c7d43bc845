// DECLARED_MOTIONS and PREDICTIONS on the wire: lcmtypes/track_set_t.lcm. Pieces and α of all tracks travel as one flat
// array.
#pragma once

#include "core/world/track.h"
#include "messages/codec.h"

namespace tern {

template <>
Bytes encode(const TrackSet& value);
/// Inconsistent: the tracks' piece counts do not sum to the pieces; two tracks with one id; a static track that has
/// more than one piece or moves.
template <>
tl::expected<TrackSet, Rejection> decode(std::span<const std::uint8_t> bytes);

}  // namespace tern
