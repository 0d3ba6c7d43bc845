// Complete sets ↔ numbered batches of one message each (DESIGN: sizes and loss).
#pragma once

#include <vector>

#include "core/world/observation.h"
#include "core/world/track.h"

namespace tern {

/// Cuts a complete set into 1 … kMaxBatches batches that encode() takes, in the order in which its tracks are given:
/// put those first that can reach the vehicle soonest. Header, set number, time and confidence are copied from `whole`
/// into each batch; index and count are set. What does not fit, and a track of more than kMaxPiecesPerBatch pieces, is
/// left out and added to `whole.left_out` in every batch. An empty set is one empty batch. O(tracks).
std::vector<TrackSet> split_batches(const TrackSet& whole);
std::vector<ObstacleTruth> split_batches(const ObstacleTruth& whole);

/// The set again, sorted by id; header and set number of the first batch, batch 0 of 1. Where batches disagree (an
/// honest sender's do not) the careful value holds: the oldest time, the least confidence, the most left out; of an id
/// that occurs twice both remain.
/// @param batches  all batches of one set, as BatchCollector gives them. @throws std::invalid_argument when there is
/// none.
TrackSet join_batches(std::vector<TrackSet> batches);
ObstacleTruth join_batches(std::vector<ObstacleTruth> batches);

}  // namespace tern
