// Synthetic recordings of moving obstacles, for motions that no available recording contains.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "tools/calibrate/recording.h"

namespace tern::calibrate {

enum class SyntheticMotion {
  Walkers,    ///< 0.5 … 1.8 m/s, white acceleration of 0.08 … 0.25 m/s^1.5, and the sway of a head
  Wanderers,  ///< sums of sines, 0.2 … 1.2 m/s, with a time scale of 1 … 4 s
  Racers,  ///< sums of sines, 1.5 … 6 m/s, with a time scale of 0.5 … 2 s, or acceleration that jumps once a second
  Drifters,  ///< white acceleration of 0.3 … 0.9 m/s^1.5
  Turners,   ///< 0.8 … 2 m/s straight on, with turns to a random direction 0.3 times a second
  Loopers,   ///< up to some 5 m/s, on loops of one shape and rate per recording, each with its own size and phase
};
struct SyntheticSource {
  SyntheticMotion motion;
  std::string_view name;
  double weight;               ///< Source::weight
  bool is_predictable = true;  ///< by models of the bank; otherwise only the learnt model's predictions are used
};
/// All sources. No model but the reach set predicts turners, so they have a small weight.
const std::vector<SyntheticSource>& synthetic_sources();

/// Returns the first 12 s of a flight with twelve obstacles at a time, 20 m apart. Each exists for 1.5 to 9 s, and its
/// truth is known at 30 Hz. Depending on the seed, the sensor sends 30, 15 or 10 sets a second, exact or with σ of
/// 0.02 to 0.1 m. Detections arrive 50 ms late, and 5 % are dropped. A function of source and seed.
Recording synthetic_recording(const SyntheticSource& source, std::uint64_t seed);

}  // namespace tern::calibrate
