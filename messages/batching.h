// Complete sets ↔ numbered batches of one message each (DESIGN: sizes and loss).
#pragma once

#include <cstddef>
#include <vector>

#include "core/world/observation.h"
#include "core/world/track.h"

namespace tern {

/// Cuts a complete set into 1 … kMaxBatches batches that encode() takes, in the order of its tracks. Put those first
/// that can reach the vehicle soonest. Header, set number, time and confidence are copied from `whole` into each batch;
/// index and count are set. An empty set is one empty batch.
///
/// What is too long is made coarser, not left out. Where the tracks do not fit, each is resampled to its share, its
/// error in α (core/world/resampling.h). A share is 2s pieces in the first half of the order and s in the second, with
/// the largest s for which all fit. Some 1900 tracks fit with one piece each; those beyond are left out, the last ones
/// first. So is a track whose resampled numbers leave a message's ranges (α beyond 1e6 m, pieces of weeks). `left_out`
/// of every batch counts them, added to `whole.left_out`. O(tracks), or O(n log n) of the pieces to resample.
std::vector<TrackSet> split_batches(const TrackSet& whole);
std::vector<ObstacleTruth> split_batches(const ObstacleTruth& whole);

/// The most pieces, up to kMaxPiecesPerBatch, for each of `tracks` declared tracks if one set shall hold them all
/// beside `single` tracks of one piece. It is 0 when they are too many even with one piece each. O(tracks).
std::size_t pieces_for_each(std::size_t tracks, std::size_t single);

/// The set again, sorted by id; header and set number of the first batch, batch 0 of 1. Where batches disagree (an
/// honest sender's do not) the careful value holds: the oldest time, the least confidence, the most left out. Of an id
/// that occurs twice both remain.
/// @param batches  all batches of one set, as BatchCollector gives them. @throws std::invalid_argument when there is
/// none.
TrackSet join_batches(std::vector<TrackSet> batches);
ObstacleTruth join_batches(std::vector<ObstacleTruth> batches);

}  // namespace tern
