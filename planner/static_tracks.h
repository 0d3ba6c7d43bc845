// A memory of static and of wide resting tracks. A prediction set may leave out distant ones, but a path to the goal
// needs them all.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "core/base/time.h"
#include "core/base/types.h"
#include "core/world/track.h"

namespace tern {

/// Returns the box with each side farther out, at the next multiple of `step`. A side that is at most `tolerance`
/// beyond a multiple is put there.
Box rounded_out(const Box& box, double step, double tolerance = 0.0);

/// The boxes around which a path to the goal leads, W, not inflated by the body.
struct PathObstacles {
  std::vector<Box> fixed;  ///< of static tracks
  /// Of tracks that rest and are wide, alone or with those that they touch. They may move, so they count only if they
  /// leave a way.
  std::vector<Box> resting;
  /// The margin of the map's boxes, m: PoseError::margin() at the vehicle. It counts only if it leaves a way.
  double map_margin = 0.0;

  [[nodiscard]] std::vector<Box> all() const {
    std::vector<Box> boxes = fixed;
    boxes.insert(boxes.end(), resting.begin(), resting.end());
    return boxes;
  }
};

/// Keeps the newest box of every static track that one predictor has sent.
///
/// | event                                                     | effect                              |
/// |-----------------------------------------------------------|-------------------------------------|
/// | a set contains the track                                  | its box is replaced by the newest   |
/// | a set omits a track that < kRememberedAfter sets contained | the track is forgotten              |
/// | a set omits another track                                 | the track is kept                   |
/// | a set comes from another predictor (a new sender epoch)   | all tracks are forgotten            |
///
/// An estimated track is *at rest* if it is predicted to stay within kRestingWay for a second. The search of a plan
/// finds ways around obstacles that are smaller than its reach; around wider ones, only a path to the goal does. Tracks
/// whose boxes touch are one obstacle, such as the three walls of a dead end. If it is at least kWide, it is one of
/// obstacles().
///
/// | event                                                            | effect                                    |
/// |------------------------------------------------------------------|-------------------------------------------|
/// | a track is at rest for kRestedFor                                | its box with the least α so far is kept   |
/// | its newest box leaves the kept one, or is smaller by kMuchSmaller | the box is replaced by the newest         |
/// | the track moves, or both faces of an axis do by kMovedAway       | it is forgotten, and may come to rest anew |
/// | sets omit it for kOmittedFor                                     | it is forgotten                           |
///
/// α grows while a track is out of sight, though nothing more is known of it. So a path that leads out of a pocket
/// would close behind the vehicle; that is why the least α counts here. The check of a plan takes the whole α.
///
/// The margin of the map is that of the newest set, rounded up to kMarginStep. It stays while the new one is smaller by
/// less than three steps.
///
/// A false track that appears once thus blocks a path only until the next set. The state depends on the sets alone.
class StaticTracks {
 public:
  static constexpr int kRememberedAfter = 3;
  static constexpr Duration kRestedFor{2'000'000}, kOmittedFor{5'000'000};
  /// The least horizontal size of resting tracks around which a path leads, m; more than the usual r = 4 m.
  static constexpr double kWide = 5.0;
  static constexpr double kRestingWay = 0.1, kMovedAway = 0.5, kMuchSmaller = 1.0;  ///< m
  /// Boxes of resting tracks are rounded outwards to multiples of this, m. So they change seldom, and paths with them.
  static constexpr double kBoxStep = 0.25;
  static constexpr double kMarginStep = 0.1;  ///< m

  StaticTracks();

  /// @param set  complete. @return whether obstacles() changed
  bool add(const TrackSet& set);

  [[nodiscard]] const PathObstacles& obstacles() const { return obstacles_; }  ///< each in order of track id
  [[nodiscard]] const std::vector<Box>& boxes() const { return obstacles_.fixed; }
  /// Returns digest_of() the fixed, then the resting boxes, and a box of the map's margin if there is one.
  [[nodiscard]] std::uint64_t digest() const { return digest_; }
  [[nodiscard]] std::int64_t epoch_us() const { return epoch_us_; }    ///< sender epoch of the predictor; 0: no set yet
  [[nodiscard]] std::int64_t first_set() const { return first_set_; }  ///< number of the predictor's first set; 0: none

 private:
  struct Known {
    Box box;
    int sets = 0;  ///< sets that contained it, at most kRememberedAfter
  };
  struct Resting {
    UTime since, seen;
    Box place;               // where it came to rest
    Vec3 alpha;              // the least so far
    std::optional<Box> box;  // once it has rested for kRestedFor
    Box bare;                // the same without α
  };
  bool add_static(const TrackSet& set);
  bool add_resting(const TrackSet& set);
  bool add_map_margin(const TrackSet& set);
  static bool take_box(const Track& track, Resting& resting);
  [[nodiscard]] std::vector<Box> wide_boxes() const;  ///< O(n²) in the resting tracks; called when a box changes

  std::map<std::int64_t, Known> by_id_;
  std::map<std::int64_t, Resting> resting_;
  PathObstacles obstacles_;
  std::uint64_t digest_;
  std::int64_t epoch_us_ = 0, first_set_ = 0;
};

/// Returns a digest of the boxes, in their order.
std::uint64_t digest_of(const std::vector<Box>& boxes);

}  // namespace tern
