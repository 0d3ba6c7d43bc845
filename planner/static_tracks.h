// A memory of static tracks. A prediction set may leave out distant ones, but a path to the goal needs them all.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/base/types.h"
#include "core/world/track.h"

namespace tern {

/// Keeps the newest box of every static track that one predictor has sent.
///
/// | event                                                     | effect                              |
/// |-----------------------------------------------------------|-------------------------------------|
/// | a set contains the track                                  | its box is replaced by the newest   |
/// | a set omits a track that < kRememberedAfter sets contained | the track is forgotten              |
/// | a set omits another track                                 | the track is kept                   |
/// | a set comes from another predictor (a new sender epoch)   | all tracks are forgotten            |
///
/// A false track that appears once thus blocks a path only until the next set. The state depends on the sets alone.
class StaticTracks {
 public:
  static constexpr int kRememberedAfter = 3;

  StaticTracks();

  /// @param set  complete. @return whether boxes() changed
  bool add(const TrackSet& set);

  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }  ///< in order of track id, not inflated, W
  [[nodiscard]] std::uint64_t digest() const { return digest_; }          ///< digest_of(boxes())
  [[nodiscard]] std::int64_t epoch_us() const { return epoch_us_; }    ///< sender epoch of the predictor; 0: no set yet
  [[nodiscard]] std::int64_t first_set() const { return first_set_; }  ///< number of the predictor's first set; 0: none

 private:
  struct Known {
    Box box;
    int sets = 0;  ///< sets that contained it, at most kRememberedAfter
  };
  std::map<std::int64_t, Known> by_id_;
  std::vector<Box> boxes_;
  std::uint64_t digest_;
  std::int64_t epoch_us_ = 0, first_set_ = 0;
};

/// Returns a digest of the boxes, in their order.
std::uint64_t digest_of(const std::vector<Box>& boxes);

}  // namespace tern
