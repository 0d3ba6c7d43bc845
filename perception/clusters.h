// Clusters of a depth picture: neighbouring pixels whose depths continue each other.
#pragma once

#include <span>
#include <vector>

#include "perception/depth_picture.h"

namespace tern {

/// The largest depth step between neighbours of one cluster is kStep + kStepSigmas · σ(z). For a lidar it is larger by
/// kStepPixels · pixel · z, since its rows are far apart on slanted surfaces.
inline constexpr double kStep = 0.25;             ///< m: things that are nearer to each other become one cluster
inline constexpr double kStepSigmas = 2.8284271;  ///< 2√2: two standard deviations of a difference
inline constexpr double kStepPixels = 1.5;

/// Disjoint groups of pixels. A group may be split again. Memory is kept from picture to picture.
class Clusters {
 public:
  struct Group {
    int first = 0, count = 0;  ///< its pixels in the order of discovery
    int level = 0;             ///< how often its pixels were split before
  };
  static constexpr int kNone = -1;

  /// Begins with a picture whose pixels are in no group.
  void begin(const DepthPicture& picture);
  /// Makes a group of each connected set of pixels. A pixel is connected with those of its 8 neighbours that continue
  /// its depth. Afterwards these pixels are in the new groups only. O(pixels). @pre each pixel is a surface and occurs
  /// once
  void split(const DepthPicture& picture, std::span<const int> pixels, int level);

  [[nodiscard]] int count() const { return static_cast<int>(groups_.size()); }
  [[nodiscard]] const Group& group(int g) const { return groups_[idx(g)]; }
  [[nodiscard]] std::span<const int> pixels(int g) const {
    return std::span<const int>(order_).subspan(idx(groups_[idx(g)].first), idx(groups_[idx(g)].count));
  }
  /// The newest group of a pixel, or kNone.
  [[nodiscard]] int group_of(int pixel) const { return group_of_[idx(pixel)]; }

 private:
  void grow(const DepthPicture& picture, int seed, int level);

  std::vector<int> group_of_, order_;
  std::vector<float> step_;  ///< half of the depth step at a pixel, m
  std::vector<Group> groups_;
};

/// Returns the pixel beside (u, v), or −1 outside the picture. A lidar over 360° has no left and right edge.
int neighbour(const PictureShape& shape, int u, int v);

}  // namespace tern
