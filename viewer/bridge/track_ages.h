// How long each track has been in the set of predictions.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "core/world/track.h"

namespace tern {

/// Remembers from when to when each id was in every set. A track that was missing in a set begins anew.
class TrackAges {
 public:
  /// Greatest number of remembered periods. When it is reached, all are forgotten but those that last.
  static constexpr std::size_t kMaxPeriods = 100'000;

  /// Takes a complete set; one that is not newer than the last one is ignored. O(tracks · log ids).
  void receive(const TrackSet& complete_set);
  /// Returns for how long the track had been in every set at that time, s; nullopt if it was in none.
  [[nodiscard]] std::optional<double> age_s(std::int64_t id, UTime at) const;

 private:
  struct Period {
    UTime from, to;
  };
  void forget_past();

  std::map<std::int64_t, std::vector<Period>> periods_;  ///< by id, ascending
  std::size_t count_ = 0;
  std::optional<UTime> last_;  ///< of the last set
};

}  // namespace tern
