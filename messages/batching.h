// Conversion between complete sets and numbered batches of one message each.
#pragma once

#include <cstddef>
#include <vector>

#include "core/world/observation.h"
#include "core/world/track.h"

namespace tern {

/// Splits a complete set into 1 … kMaxBatches batches that encode() accepts. The order of the tracks is kept, so the
/// caller puts those first that can reach the vehicle soonest. Header, set number, time and confidence are copied into
/// each batch. An empty set gives one empty batch.
///
/// If the tracks do not fit, they are made coarser rather than left out:
///
/// 1. Each track in the first half of the order is resampled to at most 2s pieces, each other track to at most s
///    pieces. The error goes into α (core/world/resampling.h). s is the largest number for which all tracks fit.
/// 2. 1920 tracks fit with one piece each, or 1560 with shares of each axis. Further ones are left out, the last ones
/// first.
/// 3. A track is also left out if resampling takes its numbers out of a message's ranges (α beyond 1e6 m, pieces of
///    weeks).
///
/// `left_out` of every batch is `whole.left_out` plus the tracks left out here. O(tracks), or O(n log n) of the pieces
/// if tracks are resampled.
std::vector<TrackSet> split_batches(const TrackSet& whole);
std::vector<ObstacleTruth> split_batches(const ObstacleTruth& whole);

/// True if the shares of α of each piece are the same on all axes. A message has one list of shares for each piece if
/// this holds for all of its tracks, else three.
bool is_same_on_all_axes(const Track& track);

/// Returns the largest n for which one set holds `tracks` declared tracks of n pieces each and `single` tracks of one
/// piece each. It is at most kMaxPiecesPerBatch, and 0 if the tracks do not fit even with n = 1. O(tracks).
std::size_t pieces_for_each(std::size_t tracks, std::size_t single);

/// Returns the complete set, sorted by id, with header and set number of the first batch, as batch 0 of 1.
///
/// Batches of a correct sender agree in their other fields. If they differ, the cautious value is used: the oldest
/// time, the lowest confidence, the largest `left_out`. If two entries have the same id, both remain.
/// @param batches  all batches of one set, as BatchCollector returns them
/// @throws std::invalid_argument if there is no batch
TrackSet join_batches(std::vector<TrackSet> batches);
ObstacleTruth join_batches(std::vector<ObstacleTruth> batches);

}  // namespace tern
