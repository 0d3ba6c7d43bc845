// The views of features that were not used yet.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "core/world/inertial.h"
#include "estimator/filter/msckf.h"

namespace tern {

/// Collects the views of each track, and hands them out once. A track is ready when it has ended with at least
/// kLeastViews, or has a view of every clone.
///
/// A track *slips* when it goes on at another point of the image. Its views before and after may each agree with the
/// state, if little else is in view to contradict them. Each view is therefore compared with the one before it, over
/// which the IMU knows the motion. A slipped track ends, and its id is not used again while it lasts.
class TrackTable {
 public:
  /// Adds the views of a frame, that of the filter's newest clone. If most tracks seem to slip, the state is wrong and
  /// not they: they end, and begin anew.
  /// @return the number of tracks that slipped
  /// @pre the clone's number is larger than all before
  int add(const FeatureFrame& frame, const Msckf& filter);
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
  [[nodiscard]] std::set<std::int64_t> slipped(const FeatureFrame& frame, const Msckf& filter) const;
  [[nodiscard]] UsableFeature posed(std::int64_t id, const std::vector<View>& views, const std::vector<Clone>& clones,
                                    std::size_t first) const;

  std::map<std::int64_t, std::vector<View>> tracks_;  // by id
  std::map<std::int64_t, Rig> rigs_;                  // by number of the frame
  std::map<std::int64_t, View> newest_;               // of each track in the newest frame, used or not
  std::set<std::int64_t> refused_;                    // ids in the newest frame that slipped before
};
inline constexpr std::size_t kLeastViews = 3;

}  // namespace tern
