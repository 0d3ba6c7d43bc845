// The prior of the calibration: quantiles of scores on synthetic obstacles, made by tern-calibrate.
#pragma once

#include <array>
#include <cstddef>

#include "core/world/track.h"

namespace tern {

/// The probabilities of the table's quantiles. The entry at 1 is the quantile at kPriorLastProbability. The largest
/// scores, of one prediction in 400, depend on the scene and are left to be learnt.
inline constexpr std::array kPriorProbabilities{0.0, 0.2,  0.4,   0.5,   0.6,  0.7,   0.8, 0.85,
                                                0.9, 0.95, 0.975, 0.985, 0.99, 0.995, 1.0};
inline constexpr double kPriorLastProbability = 0.9975;

/// The speed of a scene: unknown, or known to be slow (kSlowSpeed). Each has its own prior.
enum class SceneSpeed { Any, Slow };
inline constexpr std::size_t kSceneSpeeds = 2;
/// A slow scene has no track as fast as this over kSpeedSpan (speed_record.h), m/s. Walking people are slower,
/// most flying and driving obstacles are faster. The slow prior is made of recordings that are slower on every axis, so
/// it includes obstacles that are a little faster.
inline constexpr double kSlowSpeed = 2.5;

/// Returns the prior share of scores above q, for a class (class_index() in calibration.h) and a band. Linear between
/// the quantiles.
double prior_share_above(SceneSpeed scene_speed, std::size_t k, std::size_t band, double q);
/// Returns the prior θ (Calibration) for a level of kConfidenceLevels.
double prior_level(SceneSpeed scene_speed, std::size_t k, std::size_t band, std::size_t level);

}  // namespace tern
