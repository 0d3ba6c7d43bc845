// The sizes of obstacles that were seen whole. They tell how long the hidden rest of a similar one may be.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/types.h"

namespace tern {

/// Two measurements of one length agree if they differ by at most this plus three standard deviations, m: a pixel at
/// 10 m.
inline constexpr double kSizeTolerance = 0.15;

/// The part of an obstacle's sizes that is known.
struct KnownSizes {
  Vec3 sizes = Vec3::Zero();       ///< m
  std::array<bool, 3> is_whole{};  ///< per axis: both ends were measured; otherwise it is at least as long
};

/// Sizes of the newest kMostSizes tracks that were seen whole.
///
/// An obstacle is *similar* to a recorded one if its measured sizes agree to kSizeTolerance, and no other size is
/// larger. Either may be turned by 90° about z. Of n + 1 similar obstacles of one population, the newest is the longest
/// with the probability 1/(n + 1).
class SizeRecord {
 public:
  static constexpr std::size_t kMostSizes = 200;
  /// Fewer similar obstacles tell nothing.
  static constexpr int kFewestSimilar = 5;

  /// Records the sizes of a track, m; they replace its earlier ones.
  void add(std::int64_t track, const Vec3& sizes);
  /// Returns the longest extent along an axis of similar obstacles, m; nullopt if there are fewer than kFewestSimilar.
  /// O(kMostSizes).
  [[nodiscard]] std::optional<double> longest(int axis, const KnownSizes& known) const;

 private:
  struct Entry {
    std::int64_t track = 0;
    Vec3 sizes = Vec3::Zero();
  };
  std::vector<Entry> entries_;  // oldest first
};

}  // namespace tern
