// Remembers what stands: a prediction set may leave out what is far, but a path to the goal needs all of it.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/base/types.h"
#include "core/world/track.h"

namespace tern {

/// The static tracks of all prediction sets that one predictor sent since the first one heard: of each id the newest
/// box. What fewer than kRememberedAfter sets have named is forgotten when the next one does not name it. So a false
/// track that came once bars no way for ever. Another predictor (a new sender epoch) starts a new memory. Deterministic
/// in the sets added.
class StaticTracks {
 public:
  static constexpr int kRememberedAfter = 3;

  StaticTracks();

  /// @param set  complete. @return whether boxes() changed.
  bool add(const TrackSet& set);

  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }  ///< by track id ascending, not inflated
  [[nodiscard]] std::uint64_t digest() const { return digest_; }          ///< digest_of(boxes())
  [[nodiscard]] std::int64_t epoch_us() const { return epoch_us_; }       ///< of the predictor; 0: no set yet
  [[nodiscard]] std::int64_t first_set() const { return first_set_; }     ///< the first set of that predictor; 0: none

 private:
  struct Known {
    Box box;
    int sets = 0;  ///< that named it, kRememberedAfter at most
  };
  std::map<std::int64_t, Known> by_id_;
  std::vector<Box> boxes_;
  std::uint64_t digest_;
  std::int64_t epoch_us_ = 0, first_set_ = 0;
};

/// Names a list of boxes.
std::uint64_t digest_of(const std::vector<Box>& boxes);

}  // namespace tern
