// The views of features that were not used yet.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/world/inertial.h"
#include "estimator/filter/msckf.h"

namespace tern {

/// Collects the views of each track, and hands them out once. A track is ready when it has ended with at least
/// kLeastViews, or has a view of every clone.
class TrackTable {
 public:
  /// Adds the views of a frame. @pre number is larger than all before
  void add(std::int64_t number, const FeatureFrame& frame);
  /// Removes and returns at most `limit` features: ended ones with the most views first, then tracks over all clones.
  /// Ended tracks that are not returned are removed as well; others keep their views.
  /// @param clones  of the filter; those before `first` have no views
  std::vector<UsableFeature> take(const std::vector<Clone>& clones, std::size_t first, int most_clones, int limit);
  /// Forgets the views of frames up to this number.
  void forget(std::int64_t number);

 private:
  struct View {
    std::int64_t number;
    StereoFeature z;
  };
  struct Rig {
    Eigen::Matrix3d R_BC;
    Vec3 p_BC;
    double baseline, sigma;
  };
  [[nodiscard]] UsableFeature posed(std::int64_t id, const std::vector<View>& views, const std::vector<Clone>& clones,
                                    std::size_t first) const;

  std::map<std::int64_t, std::vector<View>> tracks_;  // by id
  std::map<std::int64_t, Rig> rigs_;                  // by number of the frame
};
inline constexpr std::size_t kLeastViews = 3;

}  // namespace tern
