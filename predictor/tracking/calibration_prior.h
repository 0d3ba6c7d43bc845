// What calibration begins with: quantiles of scores on made-up movers (tern-calibrate made the table).
#pragma once

#include <array>
#include <cstddef>

#include "core/world/track.h"

namespace tern {

/// The table holds quantiles at these probabilities; the last one stands for 1: what one promise in 400 exceeds
/// in worlds that are not this one is left to be learnt.
inline constexpr std::array kPriorProbabilities{0.0, 0.2,  0.4,   0.5,   0.6,  0.7,   0.8, 0.85,
                                                0.9, 0.95, 0.975, 0.985, 0.99, 0.995, 1.0};
inline constexpr double kPriorLastProbability = 0.9975;

/// What is known of a world: nothing, or that what moves in it is slow (kSlowSpeed).
enum class SceneSpeed { Any, Slow };
inline constexpr std::size_t kSceneSpeeds = 2;
/// m/s, over kSpeedSpan (judge.h). Walking people are slower, what flies or drives is mostly faster. The table is of
/// recordings that are slower per axis, so that it knows movers that are a little faster.
inline constexpr double kSlowSpeed = 2.5;

/// The share of scores of a class (TrackClass) and band that exceed q: linear between the table's quantiles.
double prior_share_above(SceneSpeed scene_speed, std::size_t kind, std::size_t band, double q);
/// θ of Calibration for a level of kConfidenceLevels.
double prior_level(SceneSpeed scene_speed, std::size_t kind, std::size_t band, std::size_t level);

}  // namespace tern
