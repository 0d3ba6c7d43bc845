// Made-up movers, for classes of motion that no recording at hand holds.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "tools/calibrate/recording.h"

namespace tern::calibrate {

/// How made-up movers move.
enum class MadeUp {
  Walkers,    ///< 0.5 … 1.8 m/s, white acceleration of 0.08 … 0.25 m/s^1.5, and the sway of a head
  Wanderers,  ///< sums of sines, 0.2 … 1.2 m/s, that go on for 1 … 4 s
  Racers,     ///< sums of sines, 1.5 … 6 m/s, that go on for 0.5 … 2 s, or accelerations that jump once in a second
  Drifters,   ///< white acceleration of 0.3 … 0.9 m/s^1.5
  Turners,    ///< 0.8 … 2 m/s, straight, with turns to anywhere 0.3 times a second
  Loopers,  ///< up to some 5 m/s, on loops of one shape and rate for all of a recording, each of its own size and phase
};
struct MadeUpSource {
  MadeUp kind;
  std::string_view name;
  double weight;            ///< of Source
  bool is_foreseen = true;  ///< by models that are given; else only what is promised by the learnt one counts
};
/// All of them. Turners, whom nothing but a reach set foresees, are rare, and little is promised of them.
const std::vector<MadeUpSource>& made_up_sources();

/// The first 12 s of a flight among twelve of them, 20 m apart, each of which is there for 1.5 to 9 s, with the truth
/// at 30 Hz. By the seed the sensor sees them 30, 15 or 10 times a second, exactly or with σ up to 0.1 m, 50 ms late; 5
/// % are dropped. A function of the seed.
Recording made_up(const MadeUpSource& source, std::uint64_t seed);

}  // namespace tern::calibrate
