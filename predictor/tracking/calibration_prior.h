// What calibration begins with: quantiles of scores on recorded and made-up movers (tern-calibrate made the table).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace tern {

/// The table holds quantiles at these probabilities; the last one stands for 1: what one promise in 400 exceeds
/// in worlds that are not this one is left to be learnt.
inline constexpr std::array kPriorProbabilities{0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 0.95, 0.975, 0.985, 0.99, 0.995, 1.0};
inline constexpr double kPriorLast = 0.9975;
/// The share of broken promises that the prior's levels belong to.
inline constexpr double kPriorMiss = 0.01;

/// Scores of a class (TrackClass) and band, as many as a flight of some seconds would bring, in no order.
std::vector<float> prior_scores(std::size_t kind, std::size_t band);
/// θ of BandScores.
double prior_level(std::size_t kind, std::size_t band);

}  // namespace tern
